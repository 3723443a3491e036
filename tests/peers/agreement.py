"""How well two estimates agree, against the noise that they must have."""
from dataclasses import dataclass

import numpy as np

# How far a mean over a picture may be off: what other renderers reach among themselves. A cosine or
# an area that is lost is percents.
ACCEPTED = 1e-3
# The mean alone would not see a penumbra that is too wide on both sides; the spread does. In sigmas:
# one run in 30,000 fails by chance.
EXCESS = 4.0
AT_OUR_POINTS = "at our points"


@dataclass
class Row:
    """Umbrage against Mitsuba over a set of points."""
    quantity: str
    what: str
    required: bool
    points: int
    ours: float
    ratio: float        # ours over theirs
    ratio_sigma: float
    bias: float         # ours less theirs
    bias_sigma: float
    rmse: float
    expected: float     # root of the mean variance of the difference
    excess: float       # mean square over the expected one, in sigmas
    worst: float

    @property
    def accepted(self):
        # Through another camera points are a rounding apart, which hard edges show.
        spread = self.what != AT_OUR_POINTS or self.excess <= EXCESS
        return abs(self.ratio - 1) <= ACCEPTED and spread


@dataclass
class Agreement:
    """Umbrage's values at the points, and Mitsuba's samples of each."""
    ours: dict
    spp: int

    def row(self, key, label, theirs, keep):
        """`label` is what to say of the row, and whether it must be accepted."""
        what, required = label
        a, b = self.ours[key][keep], theirs[key][keep]
        difference = a - b
        variance = self.variance(key, theirs)[keep]
        noise = variance.mean()
        sigma = np.sqrt(noise / len(a))
        surplus = difference**2 - variance
        excess = surplus.mean() / (surplus.std() / np.sqrt(len(a)))
        return Row(
            key, what, required, len(a), a.mean(), a.mean() / b.mean(), sigma / b.mean(),
            difference.mean(), sigma, np.sqrt(np.mean(difference**2)), np.sqrt(noise), excess, np.abs(difference).max(),
        )

    def variance(self, key, theirs):
        """Of the difference at each point. Mitsuba's samples of V are independent, hence binomial,
        with the fraction from umbrage, which knows it better. Umbrage states no variance for others:
        that of R is taken to be that of V, that of E the same times E0 squared; that of E0 is left out."""
        if key != "V":
            share = {"E": self.ours["E0"] ** 2, "R": 1}.get(key, 0)
            return theirs[f"{key}.variance"] + self.ours["V.variance"] * share
        fraction = self.ours["V"]
        return fraction * (1 - fraction) / self.spp + self.ours["V.variance"]

    def noise_share(self):
        """Umbrage's variance of V over Mitsuba's."""
        fraction = self.ours["V"]
        both = (fraction * (1 - fraction) / self.spp).mean()
        return float(self.ours["V.variance"].mean() / both) if both > 0 else 0.0

    def apart(self, theirs):
        """|difference of V| in sigmas. Where umbrage says 0 or 1, it says so from a finite number
        of samples: the fraction is taken one of Mitsuba's samples away from either end."""
        fraction = (self.ours["V"] * self.spp + 1) / (self.spp + 2)
        sigma = np.sqrt(fraction * (1 - fraction) / self.spp + self.ours["V.variance"])
        return np.abs(self.ours["V"] - theirs["V"]) / sigma


def ratio(values):
    """R, E over E0: NaN where E0 is too small to divide by."""
    enough = values["E0"] > 0.01 * values["E0"].mean()
    return np.where(enough, values["E"] / np.where(enough, values["E0"], 1), np.nan)
