"""Expected values of FLIP and SSIM from independent packages, on a picture made of a formula.

Run with flip-evaluator 1.7 and scikit-image 0.26:
    python make_expected.py > expected.txt
The test regenerates the same picture (only + - * / and floor, so every bit is the same) and compares.
"""

import flip_evaluator
import numpy
from skimage.metrics import structural_similarity

WIDTH, HEIGHT = 96, 64


def ramp(x, y):
    t = min(max((x + 0.3 * y - 30.0) / 40.0, 0.0), 1.0)
    return t * t * (3.0 - 2.0 * t)


def shown(x, y):
    bands = float(int(ramp(x, y) * 6.0)) / 6.0
    return min(max(bands + ((x * 73 + y * 179) % 101) / 101.0 * 0.2 - 0.1, 0.0), 1.0)


def mask(of):
    rows = [[of(x, y) for x in range(WIDTH)] for y in range(HEIGHT)]
    return numpy.array(rows, dtype=numpy.float64).astype(numpy.float32)


def shaded(shadow):
    albedo = numpy.array([0.8, 0.5, 0.25], dtype=numpy.float32)
    return (shadow[:, :, None] * numpy.float32(0.75) + numpy.float32(0.125)) * albedo


def srgb(linear, stops):
    c = numpy.clip(linear * numpy.float32(2.0**stops), 0, 1).astype(numpy.float64)
    return numpy.where(c <= 0.0031308, 12.92 * c, 1.055 * c ** (1 / 2.4) - 0.055).astype(numpy.float32)


def main():
    truth, test = mask(ramp), mask(shown)
    ssim = structural_similarity(
        truth.astype(numpy.float64), test.astype(numpy.float64),
        gaussian_weights=True, sigma=1.5, use_sample_covariance=False, data_range=1.0,
    )
    print(f"ssim {ssim:.9f}")
    for ppd, stops in [(67.0206, 0.0), (30.0, 0.0), (67.0206, 1.5)]:
        pictures = [srgb(shaded(m), stops) for m in (truth, test)]
        _, mean, _ = flip_evaluator.evaluate(*pictures, "LDR", applyMagma=False, parameters={"ppd": ppd})
        print(f"flip {ppd} {stops} {mean:.9f}")


main()
