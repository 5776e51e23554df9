"""The parts of the tea room: images, node groups, materials, shapes, furniture, light."""
