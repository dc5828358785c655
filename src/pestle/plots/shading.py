"""Turn what the rays saw into a picture: light, soft shadow in crevices, outlines."""

import numpy as np
from numpy.typing import NDArray

from pestle.plots.raycast import CUT, FACET, Buffers

Array = NDArray[np.float64]

_LIGHT = np.array([-0.45, 0.62, -0.64]) / np.linalg.norm([-0.45, 0.62, -0.64])
_FILL = np.array([0.70, 0.10, -0.70]) / np.linalg.norm([0.70, 0.10, -0.70])
_WARMTH = np.array([0.92, 1.0, 1.10])  # shadows are warm
_CREVICE = 0.85
_OUTLINE = 0.42


def shade(seen: Buffers, colour: Array, *, reach: float, samples: int) -> Array:
    """Light the picture.

    Parameters
    ----------
    seen : Buffers
        What the rays saw.
    colour : ndarray
        Colour of every particle (N, 3), 0 to 1.
    reach : float
        Depth over which crevices darken [m], about a particle radius.
    samples : int
        Rays per pixel along each direction, averaged for smooth edges [-].

    Returns
    -------
    ndarray
        Picture (H, W, 4), 0 to 1, rows from the top down.
    """
    solid = seen.particle >= 0
    base = np.ones((*solid.shape, 3))
    base[solid] = colour[seen.particle[solid]]
    light = _light(seen)
    light *= 1.0 - _CREVICE * _crevices(seen.depth, solid, reach, samples)
    light *= 1.0 - _OUTLINE * _outline(seen, samples)
    rgb = np.clip(base * np.clip(light, 0.0, 1.2)[..., None] ** _WARMTH, 0.0, 1.0)
    rgb = np.clip(rgb + _gloss(seen)[..., None], 0.0, 1.0)
    return _average(rgb, solid, samples)[::-1]


def _light(seen: Buffers) -> Array:
    key = np.maximum(seen.normal @ _LIGHT, 0.0)
    fill = np.maximum(seen.normal @ _FILL, 0.0)
    sky = 0.5 + 0.5 * seen.normal[..., 1]
    light: Array = 0.36 + 0.62 * key + 0.14 * fill + 0.16 * sky
    light[seen.kind == CUT] = 1.0
    return light


def _gloss(seen: Buffers) -> Array:
    """Faces pressed flat by a wall or a neighbour shine a little."""
    halfway = _LIGHT + np.array([0.0, 0.0, -1.0])
    halfway /= np.linalg.norm(halfway)
    shine = np.maximum(seen.normal @ halfway, 0.0) ** 24
    strength = np.select([seen.kind == FACET, seen.kind == CUT], [0.10, 0.0], 0.035)
    return np.asarray(strength * shine)


def _crevices(
    depth: Array, solid: NDArray[np.bool_], reach: float, samples: int
) -> Array:
    """How much deeper a pixel lies than its surroundings, 0 to 1."""
    if not solid.any():
        return np.zeros_like(depth)
    far = float(depth[solid].max())
    filled = np.where(solid, depth, far)
    weight = solid.astype(np.float32)
    filled = (filled - float(depth[solid].min())).astype(np.float32)
    dark = np.zeros(depth.shape, dtype=np.float32)
    for width, strength in ((7, 0.45), (21, 0.35), (63, 0.20)):
        blur = _blurred(filled * weight, width * samples)
        mean = blur / np.maximum(_blurred(weight, width * samples), 1e-3)
        dark += strength * np.clip((filled - mean) / reach, 0.0, 1.0)
    return np.where(solid, dark, 0.0)


def _blurred(values: NDArray[np.float32], width: int) -> NDArray[np.float32]:
    """Two box filters: nearly a Gaussian, at a cost that does not grow with width."""
    from scipy.ndimage import uniform_filter

    once = uniform_filter(values, width, mode="constant")
    return np.asarray(uniform_filter(once, width, mode="constant"))


def _outline(seen: Buffers, samples: int) -> Array:
    """Thin line where two particles meet in the picture, 0 to 1."""
    from scipy.ndimage import uniform_filter

    edge = np.zeros(seen.particle.shape)
    for axis in (0, 1):
        differs = np.diff(seen.particle, axis=axis) != 0
        before = [(0, 0), (0, 0)]
        before[axis] = (0, 1)
        after = [(0, 0), (0, 0)]
        after[axis] = (1, 0)
        edge = np.maximum(edge, np.pad(differs, before))
        edge = np.maximum(edge, np.pad(differs, after))
    return np.asarray(np.clip(uniform_filter(edge, samples) * 1.2, 0.0, 1.0))


def _average(rgb: Array, solid: NDArray[np.bool_], samples: int) -> Array:
    """Mean of the rays of each pixel; where some miss, the picture is see-through."""
    height, width = solid.shape[0] // samples, solid.shape[1] // samples
    cut = (height * samples, width * samples)
    weight = solid[: cut[0], : cut[1]].astype(np.float64)
    blocks = (height, samples, width, samples)
    alpha = weight.reshape(blocks).mean(axis=(1, 3))
    weighted = rgb[: cut[0], : cut[1]] * weight[..., None]
    total = weighted.reshape(*blocks, 3).mean(axis=(1, 3))
    picture = np.zeros((height, width, 4))
    np.divide(total, alpha[..., None], out=picture[..., :3], where=alpha[..., None] > 0)
    picture[..., 3] = alpha
    return picture
