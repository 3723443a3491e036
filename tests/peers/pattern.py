"""Whether a picture of differences has a shape: nothing but noise may be in it.

Noise of two programs at one pixel knows nothing of that at another. A penumbra that is too wide, a
shadow that is off by a fraction of a pixel, or a seam give neighbours one sign. Both tests take the
size of the noise from the differences themselves: all that they assume is that signs are independent.
"""
from dataclasses import dataclass

import numpy as np

# In sigmas; one test in 16,000 fails by chance.
ACCEPTED = 4.0
# Side of a block in pixels, and how many pixels that differ make one count.
BLOCK, ENOUGH = 16, 16


@dataclass
class Pattern:
    correlation: float  # of a pixel's difference with its neighbours'
    neighbours: float   # the same in sigmas
    blocks: float       # how much blocks' sums exceed those of independent pixels, in sigmas
    worst: float        # the largest block's sum over that of independent pixels
    count: int          # of blocks

    @property
    def accepted(self):
        return abs(self.neighbours) <= ACCEPTED and abs(self.blocks) <= ACCEPTED


def pattern(difference, scale):
    """Of a picture, NaN where nothing is compared. `scale` makes pixels alike: it must not know of the
    difference."""
    even = difference / scale
    pairs = np.concatenate([(even[:, 1:] * even[:, :-1]).ravel(), (even[1:] * even[:-1]).ravel()])
    pairs = pairs[np.isfinite(pairs)]
    spread = np.sqrt(np.sum(pairs**2))
    even = np.nan_to_num(even, posinf=0, neginf=0)
    power = np.sum(even**2) / np.count_nonzero(even) if even.any() else 1.0
    several = np.count_nonzero(pairs)
    excess, worst = blocks(even)
    return Pattern(
        float(pairs.sum() / max(several, 1) / power), float(pairs.sum() / spread) if spread > 0 else 0.0,
        float(excess.sum() / np.sqrt(max(len(excess), 1))), float(worst.max(initial=0)), len(excess),
    )


def blocks(even):
    """For each block that counts: the sum of all products of two different pixels, in units of its
    own spread if signs were thrown like coins; and the block's sum likewise."""
    sums, squares, fourths, several = (summed(image) for image in (even, even**2, even**4, even != 0))
    spread = np.sqrt(2 * np.maximum(squares**2 - fourths, 0))
    count = (several >= ENOUGH) & (spread > 0)
    return ((sums**2 - squares)[count] / spread[count]), np.abs(sums[count]) / np.sqrt(squares[count])


def summed(image):
    """Over squares; what is left at the right and below is dropped."""
    height, width = (side // BLOCK * BLOCK for side in image.shape)
    return image[:height, :width].reshape(height // BLOCK, BLOCK, width // BLOCK, BLOCK).sum(axis=(1, 3)).ravel()
