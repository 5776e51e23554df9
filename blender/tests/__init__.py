"""Tests of the exporter: `python -m unittest` in the folder `blender`, with a Python that has bpy."""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
