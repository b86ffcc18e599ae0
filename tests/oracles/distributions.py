"""Distributions on the line against mpmath with 50 digits: quantiles, probabilities, densities, moments.

Each distribution is written here from its formula alone. Parameters include the limits in the help, and numbers u
both tails: 1e-300 and 1 - 2^-53.
"""
import json
import math

import mpmath as mp

F = mp.mpf
mp.mp.dps = 60
EPSILON = 2.0**-52
NUMBERS = [1e-300, 1e-200, 1e-50, 1e-12, 0.001, 0.03, 0.25, 0.5, 0.75, 0.999, 1 - 2.0**-40, 1 - 2.0**-53]
TINY = F(10) ** -58


def gamma_shares(a, x):
    """P(a, x) and Q(a, x): the series of powers, or Lentz's continued fraction."""
    if x <= 0:
        return F(0), F(1)
    power = mp.exp(a * mp.log(x) - x - mp.loggamma(a + 1))
    if x < a + 1:
        term = total = F(1)
        n = a
        while term > total * TINY:
            n += 1
            term *= x / n
            total += term
        return power * total, 1 - power * total
    b = x + 1 - a
    c, d = F(10) ** 400, 1 / b
    value, i, step = d, 1, F(0)
    while abs(step - 1) > TINY:
        b += 2
        top = -i * (i - a)
        d = 1 / (top * d + b)
        c = b + top / c
        step = c * d
        value *= step
        i += 1
    return 1 - power * a * value, power * a * value


def beta_shares(a, b, x, y):
    """I_x(a, b) and the rest, for y = 1 - x: the continued fraction of DLMF 8.17.22."""
    if x <= 0 or y <= 0:
        return (F(0), F(1)) if x <= 0 else (F(1), F(0))
    if x * (a + b + 2) > a + 1 and y * (a + b + 2) <= b + 1:
        below, above = beta_shares(b, a, y, x)
        return above, below
    power = mp.exp(a * mp.log(x) + b * mp.log(y) + mp.loggamma(a + b) - mp.loggamma(a) - mp.loggamma(b)) / a
    c, d = F(1), 1 / (1 - (a + b) * x / (a + 1))
    value, m, step = d, 1, F(0)
    while abs(step - 1) > TINY:
        top = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m))
        d = 1 / (1 + top * d)
        c = 1 + top / c
        value *= c * d
        top = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))
        d = 1 / (1 + top * d)
        c = 1 + top / c
        step = c * d
        value *= step
        m += 1
    return power * value, 1 - power * value


def normal_shares(z):
    return mp.erfc(-z / mp.sqrt(2)) / 2, mp.erfc(z / mp.sqrt(2)) / 2


def central(raw):
    """Mean, variance and skewness from E x, E x^2, E x^3."""
    m, mm, mmm = raw
    variance = mm - m * m
    return m, variance, (mmm - 3 * m * mm + 2 * m**3) / variance ** F(1.5)


def quadrature(f, low, high):
    with mp.workdps(30):
        return mp.quad(f, mp.linspace(low, high, 12), method="gauss-legendre", maxdegree=6)


class Law:
    """shares(x): F and 1 - F. size(x): scale for errors of x. moments(): mean, variance, skewness."""

    size_of = ()
    tolerance = 1e-13

    def __init__(self, **numbers):
        self.numbers = numbers
        for name, number in numbers.items():
            setattr(self, name, F(number))

    def options(self):
        return [word for name, number in self.numbers.items() for word in (f"--{name}", repr(number))]

    def spec(self):
        return self.name + ":" + ",".join(f"{name}={number!r}" for name, number in self.numbers.items())

    def size(self, x):
        return max([abs(x)] + [abs(getattr(self, name)) for name in self.size_of])

    def moments(self):
        return central([self.raw(n) for n in (1, 2, 3)])

    def raw_between(self, n, low, high):
        """E x^n restricted to an interval, by another distribution of the family, or by quadrature."""
        if not hasattr(self, "weighted"):
            low, high = max(low, self.reach[0]), min(high, self.reach[1])
            return quadrature(lambda x: x**n * self.density(x), low, high)
        factor, law = self.weighted(n)
        ends = [law.shares(x) if mp.isfinite(x) else ((F(0), F(1)) if x < 0 else (F(1), F(0))) for x in (low, high)]
        return factor * Truncated.between(*ends)


class Uniform(Law):
    name, size_of, reach = "uniform", ("low", "high"), (-mp.inf, mp.inf)

    def shares(self, x):
        return (x - self.low) / (self.high - self.low), (self.high - x) / (self.high - self.low)

    def density(self, x):
        return 1 / (self.high - self.low)

    def moments(self):
        return (self.low + self.high) / 2, (self.high - self.low) ** 2 / 12, F(0)


class LogUniform(Law):
    name, reach = "log-uniform", (-mp.inf, mp.inf)

    def shares(self, x):
        ratio = mp.log(self.high / self.low)
        return mp.log(x / self.low) / ratio, mp.log(self.high / x) / ratio

    def density(self, x):
        return 1 / (x * mp.log(self.high / self.low))

    def raw(self, n):
        return (self.high**n - self.low**n) / (n * mp.log(self.high / self.low))

    def moments(self):
        with mp.workdps(200):
            return super().moments()


class Triangular(Law):
    name, size_of, reach = "triangular", ("low", "high"), (-mp.inf, mp.inf)

    def shares(self, x):
        width = self.high - self.low
        if x < self.mode:
            below = (x - self.low) ** 2 / (width * (self.mode - self.low))
            return below, 1 - below
        above = (self.high - x) ** 2 / (width * (self.high - self.mode)) if x < self.high else F(0)
        return 1 - above, above

    def density(self, x):
        if x == self.mode:
            return 2 / (self.high - self.low)
        end = self.low if x < self.mode else self.high
        return 2 * (x - end) / (self.mode - end) / (self.high - self.low)

    def moments(self):
        a, c, b = self.low, self.mode, self.high
        square = a * a + b * b + c * c - a * b - a * c - b * c
        skewness = mp.sqrt(2) * (a + b - 2 * c) * (2 * a - b - c) * (a - 2 * b + c) / (5 * square ** F(1.5))
        return (a + b + c) / 3, square / 18, skewness


class Normal(Law):
    name, size_of = "normal", ("mean",)

    def shares(self, x):
        return normal_shares((x - self.mean) / self.deviation)

    def density(self, x):
        return mp.npdf((x - self.mean) / self.deviation) / self.deviation

    def moments(self):
        return self.mean, self.deviation**2, F(0)

    def raw_between(self, n, low, high):
        """By parts: E z^n = (n - 1) E z^(n-2) and terms at the ends."""
        a, b = ((x - self.mean) / self.deviation for x in (low, high))
        at = [(z, mp.npdf(z)) if mp.isfinite(z) else (F(0), F(0)) for z in (a, b)]
        z = [Truncated.between(normal_shares(a), normal_shares(b)), at[0][1] - at[1][1]]
        for k in (2, 3):
            z.append((k - 1) * z[k - 2] + at[0][0] ** (k - 1) * at[0][1] - at[1][0] ** (k - 1) * at[1][1])
        return sum(mp.binomial(n, k) * self.mean ** (n - k) * self.deviation**k * z[k] for k in range(n + 1))


class Lognormal(Law):
    name, tolerance = "lognormal", 7e-13

    def shares(self, x):
        return normal_shares((mp.log(x) - self.mu) / self.sigma)

    def density(self, x):
        return mp.npdf((mp.log(x) - self.mu) / self.sigma) / (self.sigma * x)

    def raw(self, n):
        return mp.exp(n * self.mu + (n * self.sigma) ** 2 / 2)

    def weighted(self, n):
        return self.raw(n), Lognormal(mu=self.mu + n * self.sigma**2, sigma=self.sigma)


class Exponential(Law):
    name = "exponential"

    def shares(self, x):
        return -mp.expm1(-self.rate * x), mp.exp(-self.rate * x)

    def density(self, x):
        return self.rate * mp.exp(-self.rate * x)

    def moments(self):
        return 1 / self.rate, 1 / self.rate**2, F(2)

    def raw_between(self, n, low, high):
        return Gamma(shape=F(1), scale=1 / self.rate).raw_between(n, low, high)


class Weibull(Law):
    name = "weibull"

    def shares(self, x):
        power = (x / self.scale) ** self.shape
        return -mp.expm1(-power), mp.exp(-power)

    def density(self, x):
        y = x / self.scale
        return self.shape / self.scale * y ** (self.shape - 1) * mp.exp(-(y**self.shape))

    def raw(self, n):
        return self.scale**n * mp.gamma(1 + n / self.shape)

    def raw_between(self, n, low, high):
        """(x / scale)^shape has a gamma distribution."""
        low, high = ((max(x, 0) / self.scale) ** self.shape for x in (low, high))
        return self.raw(n) / mp.gamma(1 + n / self.shape) * Gamma(shape=F(1), scale=F(1)).raw_between(
            n / self.shape, low, high)


class Gumbel(Law):
    name, size_of, reach = "gumbel", ("location",), (-6, 200)

    def shares(self, x):
        power = mp.exp(-(x - self.location) / self.scale)
        return mp.exp(-power), -mp.expm1(-power)

    def density(self, x):
        power = mp.exp(-(x - self.location) / self.scale)
        return power * mp.exp(-power) / self.scale

    def moments(self):
        return (self.location + self.scale * mp.euler, (self.scale * mp.pi) ** 2 / 6,
                12 * mp.sqrt(6) * mp.zeta(3) / mp.pi**3)


class Gamma(Law):
    name = "gamma"

    def shares(self, x):
        return gamma_shares(self.shape, x / self.scale)

    def density(self, x):
        y = x / self.scale
        return mp.exp((self.shape - 1) * mp.log(y) - y - mp.loggamma(self.shape)) / self.scale

    def moments(self):
        return self.shape * self.scale, self.shape * self.scale**2, 2 / mp.sqrt(self.shape)

    def weighted(self, n):
        return self.scale**n * mp.gammaprod([self.shape + n], [self.shape]), Gamma(shape=self.shape + n, scale=self.scale)


class Beta(Law):
    name = "beta"

    def __init__(self, low=0.0, high=1.0, **shapes):
        super().__init__(low=low, high=high, **shapes)
        self.size_of = ("low", "high") if low != 0 else ()

    def shares(self, x):
        width = self.high - self.low
        return beta_shares(self.a, self.b, (x - self.low) / width, (self.high - x) / width)

    def density(self, x):
        width = self.high - self.low
        y, rest = (x - self.low) / width, (self.high - x) / width
        log = mp.loggamma(self.a + self.b) - mp.loggamma(self.a) - mp.loggamma(self.b)
        return mp.exp(log + (self.a - 1) * mp.log(y) + (self.b - 1) * mp.log(rest)) / width

    def weighted(self, n):
        return mp.rf(self.a, n) / mp.rf(self.a + self.b, n), Beta(a=self.a + n, b=self.b)

    def moments(self):
        a, b, width = self.a, self.b, self.high - self.low
        return (self.low + width * a / (a + b), width**2 * a * b / ((a + b) ** 2 * (a + b + 1)),
                2 * (b - a) * mp.sqrt(a + b + 1) / ((a + b + 2) * mp.sqrt(a * b)))


class StudentT(Law):
    name, size_of = "student-t", ("location",)

    def shares(self, x):
        t = (x - self.location) / self.scale
        square = t * t / self.degrees
        tail = beta_shares(self.degrees / 2, F(0.5), 1 / (1 + square), square / (1 + square))[0] / 2
        return (tail, 1 - tail) if t < 0 else (1 - tail, tail)

    def density(self, x):
        t, nu = (x - self.location) / self.scale, self.degrees
        log = mp.loggamma((nu + 1) / 2) - mp.loggamma(nu / 2) - (nu + 1) / 2 * mp.log1p(t * t / nu)
        return mp.exp(log) / (mp.sqrt(nu * mp.pi) * self.scale)

    def moments(self):
        nu = self.degrees
        return (self.location if nu > 1 else None, self.scale**2 * nu / (nu - 2) if nu > 2 else None,
                F(0) if nu > 3 else None)

    def raw_between(self, n, low, high):
        if mp.isfinite(low) and mp.isfinite(high):
            return quadrature(lambda x: x**n * self.density(x), low, high)
        a, b = ((x - self.location) / self.scale for x in (low, high))
        t = [self.beyond(k, a) - self.beyond(k, b) for k in range(n + 1)]
        return sum(mp.binomial(n, k) * self.location ** (n - k) * self.scale**k * t[k] for k in range(n + 1))

    def beyond(self, n, t):
        """E t^n above t, up to a constant."""
        z = self.degrees / (self.degrees + t * t) if mp.isfinite(t) else F(0)
        a, b = (self.degrees - n) / 2, F(n + 1) / 2
        value = self.degrees ** (F(n) / 2) * mp.beta(a, b) / (2 * mp.beta(self.degrees / 2, F(0.5)))
        tail = value * beta_shares(a, b, z, 1 - z)[0]
        return tail if t >= 0 or n % 2 == 1 else 2 * value - tail


class Poisson(Law):
    name = "poisson"

    def shares(self, x):
        below, above = gamma_shares(mp.floor(x) + 1, self.mean)
        return above, below

    def chance(self, x):
        return mp.exp(x * mp.log(self.mean) - self.mean - mp.loggamma(x + 1))

    def moments(self):
        return self.mean, self.mean, 1 / mp.sqrt(self.mean)


class Binomial(Law):
    name = "binomial"

    def __init__(self, trials, probability):
        super().__init__(trials=trials, probability=probability)
        self.p = F(probability)

    def shares(self, x):
        k, n = mp.floor(x), self.trials
        if k < 0 or k >= n:
            return (F(0), F(1)) if k < 0 else (F(1), F(0))
        above, below = beta_shares(k + 1, n - k, self.p, 1 - self.p)
        return below, above

    def chance(self, x):
        n, log = self.trials, mp.loggamma
        return mp.exp(log(n + 1) - log(x + 1) - log(n - x + 1) + x * mp.log(self.p) + (n - x) * mp.log(1 - self.p))

    def moments(self):
        n, p = self.trials, self.p
        return n * p, n * p * (1 - p), (1 - 2 * p) / mp.sqrt(n * p * (1 - p))


class Truncated(Law):
    """A distribution truncated to an interval, either end of which may be None."""

    def __init__(self, law, low, high):
        self.law, self.low, self.high = law, low, high
        self.size_of = ()
        self.ends = [-mp.inf if low is None else F(low), mp.inf if high is None else F(high)]
        self.end_shares = [law.shares(end) if mp.isfinite(end) else ((F(0), F(1)) if end < 0 else (F(1), F(0)))
                           for end in self.ends]
        self.mass = self.between(*self.end_shares)

    @staticmethod
    def between(left, right):
        return right[0] - left[0] if right[0] < 0.5 else left[1] - right[1]

    def options(self):
        return ["--of", self.law.spec()] + [word for name, end in (("--low", self.low), ("--high", self.high))
                                            if end is not None for word in (name, repr(end))]

    def spec(self):
        ends = [f"{name}={end!r}" for name, end in (("low", self.low), ("high", self.high)) if end is not None]
        return f"truncated:of=[{self.law.spec()}]," + ",".join(ends)

    name = "truncated"

    def size(self, x):
        return max(self.law.size(x), *(abs(end) for end in self.ends if mp.isfinite(end)))

    def shares(self, x):
        at = self.law.shares(x)
        return (self.between(self.end_shares[0], at) / self.mass, self.between(at, self.end_shares[1]) / self.mass)

    def density(self, x):
        return self.law.density(x) / self.mass

    def moments(self):
        """None if the remaining tail is too heavy."""
        endless = None in (self.low, self.high)
        degrees = self.law.degrees if endless and self.law.name == "student-t" else mp.inf
        raw = [self.law.raw_between(n, *self.ends) / self.mass if degrees > n else None for n in (1, 2, 3)]
        if None not in raw:
            return central(raw)
        return raw[0], raw[1] - raw[0] ** 2 if raw[1] is not None else None, None


ENDS = [0.05, 0.3, 1.0, 1.7, 10.0, 100.0, 515.0, 3000.0, 1e5, 1e6]
CONTINUOUS = (
    [Uniform(low=a, high=b) for a, b in [(0.0, 1.0), (-1e150, 1e150), (1e8, 1e8 + 1), (-1e-150, 0.0)]]
    + [LogUniform(low=a, high=b) for a, b in [(1.0, 1.000001), (1.0, 10.0), (1.0, 54.0), (1.0, 55.0), (1e-150, 1e150),
                                              (3.0, 3.0000000000001)]]
    + [Triangular(low=a, mode=c, high=b) for a, c, b in
       [(0.0, 0.0, 1.0), (0.0, 1.0, 1.0), (0.0, 1e-9, 1.0), (-1.0, 0.0, 0.0), (0.0, 0.5, 1.0), (-1e150, 3.0, 1e150),
        (0.0, 1 - 1e-9, 1.0), (10.0, 10.0, 11.0)]]
    + [Normal(mean=m, deviation=s) for m, s in [(0.0, 1.0), (0.0, 1e-150), (-5.0, 1e-10), (0.0, 1e150), (1e5, 2.0)]]
    + [Lognormal(mu=m, sigma=s) for m, s in [(0.0, 1.0), (3.0, 1e-9), (-600.0, 1.0), (0.0, 17.0), (2.0, 0.001)]]
    + [Exponential(rate=r) for r in [1e-150, 2.0, 1e150]]
    + [Weibull(shape=k, scale=s) for k, s in [(0.05, 1.0), (0.05, 1e100), (0.5, 2.0), (1.0, 1e-100), (3.6, 1.0),
                                              (9.0, 1.0), (11.0, 1.0), (1000.0, 3.0)]]
    + [Gumbel(location=m, scale=s) for m, s in [(0.0, 1.0), (1e100, 1e100), (-7.0, 1e-10), (1.0, 1e5)]]
    + [Gamma(shape=k, scale=s) for k in ENDS for s in [1.0, 1e-100, 1e100]]
    + [Beta(a=a, b=b) for a in ENDS for b in ENDS]
    + [Beta(a=a, b=b, low=-3.0, high=5.0) for a, b in [(515.0, 515.0), (0.05, 1e6), (2.0, 3.0)]]
    + [StudentT(degrees=n, location=m, scale=s) for n in [0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 30.0, 1e3, 1e6]
       for m, s in [(0.0, 1.0), (1e4, 1e-3), (-2.0, 1e100)]]
)
DISCRETE = (
    [Poisson(mean=m) for m in [1e-12, 0.1, 1.0, 4.5, 100.0, 12345.6, 1e6, 1e8]]
    + [Binomial(trials=n, probability=p) for n, p in [(1, 0.5), (1, 1e-12), (10, 0.3), (1000, 1e-6), (10**6, 0.999),
                                                      (10**8, 0.5), (10**8, 1e-12), (10**8, 1 - 1e-12)]]
)

CUT = [
    Truncated(law, low, high)
    for law, low, high in [
        (Normal(mean=0.0, deviation=1.0), 0.0, None), (Normal(mean=0.0, deviation=1.0), 30.0, None),
        (Normal(mean=0.0, deviation=1.0), -36.0, -35.0), (Normal(mean=0.0, deviation=1.0), -1.0, 2.0),
        (Normal(mean=5.0, deviation=2.0), None, 4.0), (Normal(mean=0.0, deviation=1.0), 2.0, 2.001),
        (Exponential(rate=2.0), 300.0, None), (Exponential(rate=2.0), 0.1, 0.2),
        (Lognormal(mu=0.0, sigma=1.0), 1.0, None), (Lognormal(mu=0.0, sigma=5.0), 0.001, 1000.0),
        (Weibull(shape=0.05, scale=1.0), 1e-20, 1e20), (Weibull(shape=0.5, scale=1.0), 2.0, None),
        (Gumbel(location=0.0, scale=1.0), -1.0, None), (Gumbel(location=0.0, scale=1.0), None, 3.0),
        (Gamma(shape=0.05, scale=1.0), 1e-9, 2.0), (Gamma(shape=3000.0, scale=1.0), 3100.0, None),
        (Gamma(shape=1e6, scale=1.0), None, 990000.0), (Beta(a=515.0, b=515.0), 0.5, 0.6),
        (Beta(a=0.05, b=0.05), 0.25, 0.75), (Beta(a=1e6, b=1e6), 0.51, 1.0), (Beta(a=1e4, b=200.0), 0.9, 0.97),
        (Uniform(low=0.0, high=1.0), 0.25, 0.5), (LogUniform(low=1.0, high=1e6), 2.0, 3.0),
        (Triangular(low=0.0, mode=0.0, high=1.0), 0.5, 1.0), (StudentT(degrees=1.0, location=0.0, scale=1.0), -2.0, 5.0),
        (StudentT(degrees=1.0, location=0.0, scale=1.0), 1.0, None),
        (StudentT(degrees=2.0, location=0.0, scale=1.0), 1.0, None),
        (StudentT(degrees=2.5, location=0.0, scale=1.0), None, 1.0),
        (StudentT(degrees=3.0, location=0.0, scale=1.0), 0.0, None),
        (StudentT(degrees=3.5, location=1.0, scale=2.0), -1.0, None),
        (StudentT(degrees=30.0, location=0.0, scale=1.0), 1e6, None),
    ]
]


def warped(cases, law, numbers, *more):
    """Images of numbers under the distribution's warp, one per row."""
    return cases.points("warp", law.name, *law.options(), *more, "-", text="".join(f"{x!r}\n" for x in numbers))


def with_densities(cases, law, numbers):
    """The same with densities, for those at which the density is finite."""
    while True:
        try:
            return list(zip(numbers, warped(cases, law, numbers, "--with-pdf")))
        except RuntimeError as error:
            if "is infinite" not in str(error):
                raise
            numbers = numbers[1:]


def rounding(law, x):
    """Change of the logarithm of the density over 4 units in the last place of x."""
    step = law.size(x) * F(2) ** -70
    try:
        ratio = law.density(x + step) / law.density(x - step)
        return 4 * EPSILON * abs(mp.log(ratio)) * F(2) ** 69 if ratio > 0 else F(0)
    except OverflowError:  # all of the law is within the step
        return mp.inf
    except (TypeError, ValueError, ZeroDivisionError):  # beside an end
        return F(0)


def check_quantiles(cases):
    """Quantiles and densities of continuous laws, both tails: 1e-13"""
    for law in CONTINUOUS:
        for u, (ours, density) in with_densities(cases, law, NUMBERS):
            x = F(ours)
            at_end = not 1e-299 < abs(ours) < 1e308 or ours in (law.numbers.get("low"), law.numbers.get("high"))
            right = F(0) if at_end else law.density(x)
            if not (mp.isfinite(right) and right > 0):
                continue  # at an end, or beyond the smallest numbers
            below, above = law.shares(x)
            off = below - F(u) if u < 0.5 else F(1) - F(u) - above
            cases.compare(f"{law.spec()}, u = {u}", ours, x - off / right, 0, law.tolerance * float(law.size(x)))
            if 1e-300 < right < 1e300:
                cases.compare(f"{law.spec()}, density at {ours}", density, right, 1e-13 + float(rounding(law, x)))


def check_probabilities(cases):
    """Probabilities of continuous laws, the way back: 1e-13, up to roundings of x"""
    for law in CONTINUOUS:
        numbers = [u for u in NUMBERS if u < 0.9]
        at = [(u, row[0]) for u, row in zip(numbers, warped(cases, law, numbers)) if 1e-299 < abs(row[0]) < 1e308]
        if not at:
            continue
        back = warped(cases, law, [x for _, x in at], "--inverse")
        for (_, x), (ours,) in zip(at, back):
            below = law.shares(F(x))[0]
            if below > 1e-300 and mp.isfinite(law.density(F(x))):
                room = 1e-13 + float(4 * EPSILON * law.size(F(x)) * law.density(F(x)) / below)
                cases.compare(f"{law.spec()}, share below {x}", ours, below, room)


def check_truncated(cases):
    """Truncated laws: quantiles, probabilities and densities, relative to the interval"""
    for law in CUT:
        numbers = NUMBERS[3:]
        for u, (ours, density) in zip(numbers, warped(cases, law, numbers, "--with-pdf")):
            x, right = F(ours), law.density(F(ours))
            room = 1e-13 + float(8 * EPSILON * law.size(x) * right)
            cases.compare(f"{law.spec()}, u = {u}", u, law.shares(x)[0], 0, room)
            cases.compare(f"{law.spec()}, density at {ours}", density, right, 1e-12 + float(rounding(law, x)))


def check_outcomes(cases):
    """Discrete laws: the outcome of each number, and its probability"""
    for law in DISCRETE:
        numbers = NUMBERS[:-2] if law.moments()[0] < 1e7 else [1e-50, 0.25, 0.999]
        for u, (ours, density) in zip(numbers, warped(cases, law, numbers, "--with-pdf")):
            at, before = law.shares(F(ours)), law.shares(F(ours) - 1) if ours > 0 else (F(0), F(1))
            near, half = F(10) ** -13, F(2) ** -54  # F is a double
            if u < 0.5:
                holds = before[0] <= u * (1 + near) and at[0] > u * (1 - near)
            else:
                holds = before[1] >= (1 - u) * (1 - near) - half and at[1] < (1 - u) * (1 + near) + half
            cases.expect(f"{law.spec()}, u = {u}", holds, f"{ours}, before it {mp.nstr(before[0], 17)}, to it {mp.nstr(at[0], 17)}")
            cases.compare(f"{law.spec()}, probability of {ours}", density, law.chance(F(ours)), 1e-12)


def check_moments(cases):
    """Exact moments: 1e-9, or missing where there are none"""
    for law in CONTINUOUS + CUT + DISCRETE:
        made = cases.run("generate", "random", "-n", 4, "-d", 1, "-w", law.spec(), "-f", "json")
        try:
            exact = cases.results("moments", "-", text=made)["exact"]
        except RuntimeError as error:
            if "beyond the largest double" not in str(error):
                raise
            continue  # the points' own moments are refused
        names = ("mean", "variance", "skewness")
        right = law.moments()
        for name, number in zip(names, right):
            what = f"{law.spec()}, {name}"
            if number is None or not 1e-307 < abs(number) + (name != "variance") < 1e300:
                cases.expect(what, name not in exact and not exact["known"] and name in exact["missing"], str(exact))
            elif name not in exact:
                beyond = not 1e-200 < float(right[1]) < 1e200  # third moments leave the range of numbers
                cases.expect(what, name == "skewness" and beyond, f"missing, should be {mp.nstr(number, 17)}")
            else:
                size = 0.1 if name == "skewness" else float(mp.sqrt(right[1])) if name == "mean" and right[1] else 0
                cases.compare(what, exact[name][0], number, 1e-9, 1e-9 * size)


def check_places(cases):
    """The same laws in parameter files, and of Dirichlet's coordinates"""
    numbers = [1e-50, 0.01, 0.25, 0.5, 0.75]
    text = "".join(f"{u!r}\n" for u in numbers)
    for a, b in [(300.0, 3000.0), (515.0, 515.0), (1e4, 200.0), (1e6, 1e6), (0.1, 9e5)]:
        law = Beta(a=a, b=b)
        plain = warped(cases, law, numbers)
        file = {"parameters": [{"name": "y", "distribution": "beta", "a": a, "b": b}]}
        spec = json.dumps(file, separators=(",", ":"))
        cases.expect(f"{law.spec()} in a parameter file",
                     cases.points("warp", "parameters", "--json", spec, "-", text=text) == plain)
        if a + b > 1e6:
            continue
        rows = cases.points("warp", "dirichlet", "--alpha", f"{a!r},{b!r}", "--with-pdf", "-", text=text)
        for u, (x, rest, density) in zip(numbers, rows):
            if x <= 1e-299:
                continue
            off = (law.shares(F(x))[0] - F(u)) / law.density(F(x))
            cases.compare(f"dirichlet {a}, {b}, u = {u}", x, F(x) - off, 1e-12)
            right = law.density(F(x)) / mp.sqrt(2)
            cases.compare(f"dirichlet {a}, {b}, density at {x}", density, right,
                          1e-12 + float(rounding(law, F(x))) + EPSILON * max(a, b))  # that of the other coordinate
