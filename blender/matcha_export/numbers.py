"""Blender's values as JSON numbers."""

import math

LARGEST = 3.4028235e38


def number(value):
    """A float with the nine digits that identify a 32-bit one; never NaN or infinite."""
    value = float(value)
    if value != value:
        return 0.0
    if math.isinf(value):
        return math.copysign(LARGEST, value)
    return float(f"{value:.9g}")


def numbers(values):
    """A flat list of `number`s."""
    return [number(value) for value in values]


def columns(matrix):
    """A matrix as a flat list, column by column."""
    return [number(x) for column in zip(*matrix) for x in column]
