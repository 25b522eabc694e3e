"""By which angles one outline may have to be turned to lie over another: `candidate_turns`.

Seen from the centre, a boundary is a density over distance and direction. Its Fourier coefficients in the direction,
one row for each ring of distances, are multiplied by ``exp(-i n a)`` when the outline turns by ``a``; so the
correlation of two outlines over all angles at once is one inverse transform. Nothing depends on how a boundary is cut
into edges, and a shape with n-fold symmetry simply has n equal peaks, where moments of second and third order vanish.
"""

import numpy as np

from mashape_cad.geometry.edge import Floats

__all__ = ["Spectrum", "candidate_turns", "spectrum"]

Spectrum = np.ndarray[tuple[int, int], np.dtype[np.complex128]]

# Rings of distances, from the centre to this many times the reach. Few rings blur what lies where, many make noise of
# stations that fall into the next one.
_RINGS, _FARTHEST = 16, 2.5
# Directions told apart: features of about two degrees.
_HARMONICS = 128
# Angles at which the correlation is looked at: four to the finest wave.
_ANGLES = 1024
# Of the highest peak: lower ones are not tried.
_WORTH_TRYING = 0.5


def spectrum(spoke: Floats, weight: Floats) -> Spectrum:
    """Return the Fourier coefficients of a boundary's density about its centre: (rings, harmonics).

    Parameters
    ----------
    spoke : (n, 2) array
        From the centre to stations on the boundary, in units of the reach: then move and scale play no part.
    weight : (n,) array
        Length of boundary that each station stands for, in the same unit.
    """
    distance = np.hypot(*spoke.T)
    turn = (spoke @ np.array([1.0, -1.0j])) / np.maximum(distance, np.finfo(float).tiny)  # exp(-i a)
    waves = np.cumprod(np.broadcast_to(turn[:, None], (len(turn), _HARMONICS)), axis=1)
    place = np.clip(distance / _FARTHEST * (_RINGS - 1), 0, _RINGS - 1)
    shares = np.clip(1 - np.abs(place - np.arange(_RINGS)[:, None]), 0, 1)
    return (shares * weight) @ waves


def candidate_turns(target: Spectrum, source: Spectrum, most: int) -> Floats:
    """Return angles by which the source may have to be turned to lie over the target, the likeliest first.

    Parameters
    ----------
    target, source : (rings, harmonics) arrays
        See `spectrum`; for a mirror image (in the x axis) of the source pass its conjugate.
    most : int
        At most so many.

    Returns
    -------
    (n,) array
        Radians; a single 0 if no direction differs from any other, as on a disc.
    """
    product = np.sum(target * np.conj(source), axis=0)
    waves = np.zeros(_ANGLES // 2 + 1, complex)
    waves[1 : _HARMONICS + 1] = product
    match = np.fft.irfft(waves, _ANGLES)
    before, after = np.roll(match, 1), np.roll(match, -1)
    peaks = np.flatnonzero((match >= before) & (match > after) & (match > _WORTH_TRYING * match.max()))
    if len(peaks) == 0:
        return np.zeros(1)
    peaks = peaks[np.argsort(-match[peaks], kind="stable")][:most]
    bend = before[peaks] - 2 * match[peaks] + after[peaks]
    shift = (before[peaks] - after[peaks]) / (2 * np.where(bend < 0, bend, -np.inf))
    return (peaks + shift) * (2 * np.pi / _ANGLES)
