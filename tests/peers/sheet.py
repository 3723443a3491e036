"""Pictures of differences, all of them on one sheet, in units of their noise."""
import mitsuba as mi
import numpy as np

# Sigmas at which the colours end, and steps on the way: enough to see a shape, few enough for a small
# file.
END, STEPS = 4.0, 8
NOTHING, LEFT_OUT, PAPER = (40, 40, 60), (255, 220, 90), (120, 120, 120)
LESS, MORE = np.array([20, 80, 200]), np.array([200, 40, 20])
MARGIN = 4


def write(path, rows):
    """`rows` of pictures, each as `tile` makes them."""
    lines = [np.concatenate([framed(tile) for tile in row], axis=1) for row in rows]
    mi.Bitmap(framed(np.concatenate(lines)).astype(np.uint8)).write(str(path))


def tile(difference, variance, hit):
    """Half as large as the picture: the sum of four pixels in units of its noise. White where both say
    the same, blue where umbrage says less, red where it says more."""
    some = np.isfinite(difference)
    sums, expected, seen, compared = (halved(np.nan_to_num(image)) for image in (difference, variance, hit, some))
    sigmas = np.where(expected > 0, sums / np.sqrt(np.maximum(expected, 1e-300)), 0)
    image = coloured(sigmas / END)
    image[(seen > 0) & (compared == 0)] = LEFT_OUT
    image[seen == 0] = NOTHING
    return image


def coloured(part):
    """-1 is blue, 0 white and 1 red."""
    step = np.clip(np.round(part * STEPS) / STEPS, -1, 1)
    weight = np.abs(np.nan_to_num(step))[..., None]
    return 255 + weight * (np.where(step[..., None] < 0, LESS, MORE) - 255)


def halved(image):
    height, width = (side // 2 * 2 for side in image.shape)
    image = image[:height, :width].astype(float)
    return image.reshape(height // 2, 2, width // 2, 2).sum(axis=(1, 3))


def framed(image):
    return np.pad(image, ((MARGIN, MARGIN), (MARGIN, MARGIN), (0, 0)), constant_values=PAPER[0])
