"""From Blender's axes (Z up) to glTF's (Y up), and matrices to node transforms."""

import numpy as np

# Rows of the change of basis (x, y, z) -> (x, z, -y).
TO_GLTF = np.array([[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]], dtype=np.float64)

# A matrix whose columns are this far from orthogonal counts as sheared.
SHEAR = 1e-5


def points(array):
    """(n, 3) Blender positions or directions in glTF's axes, single precision."""
    out = np.empty_like(array, dtype=np.float32)
    out[:, 0] = array[:, 0]
    out[:, 1] = array[:, 2]
    out[:, 2] = -array[:, 1]
    return out


def placement(matrix):
    """World matrix of a node whose content is converted to glTF's axes as well."""
    return TO_GLTF @ np.asarray(matrix, dtype=np.float64) @ TO_GLTF.T


def aim(matrix):
    """World matrix of a camera or light, whose local axes are the same in both worlds."""
    return TO_GLTF @ np.asarray(matrix, dtype=np.float64)


def quaternion(rotation):
    """(x, y, z, w) of a proper rotation matrix (Shepperd, 1978)."""
    m = rotation
    trace = m[0, 0] + m[1, 1] + m[2, 2]
    choice = int(np.argmax([m[0, 0], m[1, 1], m[2, 2], trace]))
    if choice == 3:
        q = np.array([m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], 1.0 + trace])
    else:
        i, j, k = choice, (choice + 1) % 3, (choice + 2) % 3
        q = np.empty(4)
        q[i] = 1.0 + 2.0 * m[i, i] - trace
        q[j] = m[j, i] + m[i, j]
        q[k] = m[k, i] + m[i, k]
        q[3] = m[k, j] - m[j, k]
    return q / np.linalg.norm(q)


def decompose(matrix):
    """(translation, quaternion, scale) of a 4x4 matrix, or None where it is sheared or flat."""
    linear = matrix[:3, :3]
    scale = np.linalg.norm(linear, axis=0)
    if scale.min() <= 1e-12 * max(scale.max(), 1e-30):
        return None
    axes = linear / scale
    cosines = axes.T @ axes
    if max(abs(cosines[0, 1]), abs(cosines[0, 2]), abs(cosines[1, 2])) > SHEAR:
        return None
    if np.linalg.det(axes) < 0.0:
        axes = -axes
        scale = -scale
    u, _, vt = np.linalg.svd(axes)
    return matrix[:3, 3], quaternion(u @ vt), scale


def trs(translation, rotation, scale):
    """glTF's properties of a node; defaults are left out."""
    node = {}
    if np.any(translation):
        node["translation"] = [float(x) for x in translation]
    if not np.allclose(rotation, (0, 0, 0, 1), rtol=0.0, atol=1e-12):
        node["rotation"] = [float(x) for x in rotation]
    # Single precision turns a rotation's unit scale into 0.99999999.
    if not np.allclose(scale, 1.0, rtol=5e-7, atol=0.0):
        node["scale"] = [float(x) for x in scale]
    return node


def node_chain(matrix):
    """One node's transform, or two for a sheared matrix: M = (T U S) (V^T), outer first.

    glTF's nodes hold no shear, but by the singular value decomposition every linear map
    is a rotation, a scale, and another rotation.
    """
    parts = decompose(matrix)
    if parts is not None:
        return [trs(*parts)]
    u, s, vt = np.linalg.svd(matrix[:3, :3])
    if np.linalg.det(u) < 0.0:
        u = -u
        s = -s
    if np.linalg.det(vt) < 0.0:
        vt = -vt
        s = -s
    one = np.ones(3)
    return [trs(matrix[:3, 3], quaternion(u), s), trs(np.zeros(3), quaternion(vt), one)]
