"""Who sees an object, its random number, and the rest of what Object Info knows."""

from .numbers import numbers

MASK = 0xFFFFFFFF


def of_object(obj):
    """Cycles' ray visibility."""
    return {
        "camera": bool(obj.visible_camera),
        "diffuse": bool(obj.visible_diffuse),
        "glossy": bool(obj.visible_glossy),
        "transmission": bool(obj.visible_transmission),
        "shadow": bool(obj.visible_shadow),
    }


def of_instance(instance, view_layer):
    """Visibility of a placed object; an instancer restricts what it places."""
    seen = of_object(instance.object)
    parent = instance.parent if instance.is_instance else instance.object
    if instance.is_instance:
        by_parent = of_object(parent)
        seen = {ray: seen[ray] and by_parent[ray] for ray in seen}
    if not holdout(parent, view_layer) and parent.original.indirect_only_get(view_layer=view_layer):
        seen["camera"] = False
    return seen


def holdout(obj, view_layer):
    """Cuts a hole, by its own flag or its collection's."""
    return bool(obj.is_holdout or obj.original.holdout_get(view_layer=view_layer))


def about(instance, view_layer):
    """The node's extension entry, without what differs from copy to copy."""
    obj = instance.object
    parent = instance.parent if instance.is_instance else obj
    entry = {
        "name": obj.name,
        "pass_index": int(obj.pass_index),
        "color": numbers(obj.color),
        "visibility": of_instance(instance, view_layer),
        "holdout": holdout(parent, view_layer),
    }
    if obj.is_shadow_catcher or parent.is_shadow_catcher:
        entry["shadow_catcher"] = True
    return entry


def random(instance):
    """Object Info's random number, 0 to 1, as Cycles derives it from its 32-bit identity."""
    if instance.is_instance:
        identity = instance.random_id & MASK
    else:
        identity = mix(name_hash(instance.object.name))
    return identity / MASK


def name_hash(name):
    """Cycles' hash of an object's name: digits of base 37, modulo 2^32."""
    value = 0
    for byte in name.encode("utf-8"):
        value = (value * 37 + byte) & MASK
    return value


def mix(key):
    """Jenkins' lookup3 (2006), final mixing of the two words (key, 0)."""
    a = b = c = (0xDEADBEEF + (2 << 2) + 13) & MASK
    a = (a + key) & MASK
    for first, turn in enumerate((14, 11, 25, 16, 4, 14, 24)):
        state = [a, b, c]
        target, source = ((2, 1), (0, 2), (1, 0))[first % 3]
        word = state[source]
        rotated = ((word << turn) | (word >> (32 - turn))) & MASK
        state[target] = ((state[target] ^ word) - rotated) & MASK
        a, b, c = state
    return c
