"""Prints what other programs say of the two pictures of tests/tests/compare.rs.

pip install flip-evaluator==1.7 scikit-image==0.26 numpy
"""

import flip_evaluator
import numpy
from skimage.metrics import peak_signal_noise_ratio, structural_similarity

WIDTH, HEIGHT = 96, 64
y, x = numpy.mgrid[0:HEIGHT, 0:WIDTH]


def picture(shift):
    x_shifted = x + shift
    rgb = numpy.stack([(x_shifted * 5 + y) % 256, (x_shifted * y // 8) % 256, ((x_shifted // 8 ^ y // 8) & 1) * 200], -1)
    return rgb.astype(numpy.float32) / 255


def linear(encoded):
    encoded = encoded.astype(numpy.float64)
    return numpy.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


a, b = picture(0), picture(1)
luma = [image.astype(numpy.float64) @ [0.2126, 0.7152, 0.0722] for image in (a, b)]
errors, mean, _ = flip_evaluator.evaluate(a, b, "LDR", applyMagma=False, parameters={"ppd": 67.02064})
errors = numpy.sort(errors.ravel())
print("rmse", numpy.sqrt(numpy.mean((linear(a) - linear(b)) ** 2)))
print("psnr", peak_signal_noise_ratio(a.astype(numpy.float64), b.astype(numpy.float64), data_range=1))
print("ssim", structural_similarity(*luma, data_range=1, gaussian_weights=True, sigma=1.5, use_sample_covariance=False))
print("flip mean", mean)
print("flip p99", errors[int(numpy.ceil(0.99 * errors.size)) - 1], "max", errors[-1])
print("differing", numpy.count_nonzero((a != b).any(-1)))
