"""The material classes of the matrix, with what its exact answers need of them."""
import math


class Material:
    """CASE is what a case has. Elastic constants follow from bulk and shear modulus, K and G: E = 9
    K G/(3 K + G), nu = (3 K - 2 G)/(6 K + 2 G). `pressure_of` is p(density, energy), where an exact
    answer uses it.
    """

    def __init__(self, case, density, bulk, shear=0.0, speed=10.0, **more):
        self.case, self.density, self.bulk, self.shear = case, density, bulk, shear
        self.speed = speed  # of a gentle motion, m/s: strains of a thousandth to a hundredth
        self.yield_stress = more.get("yield_stress")
        self.hardening = more.get("hardening")  # B and n of Y = yield_stress + B strain^n
        self.pressure_of = more.get("pressure_of")
        self.state = more.get("state", {})  # keys of a body at rest
        self.pressure, self.energy = more.get("pressure", 0.0), more.get(
            "energy", 0.0
        )  # of that state

    @property
    def young(self):
        return 9 * self.bulk * self.shear / (3 * self.bulk + self.shear)

    @property
    def poisson(self):
        return (3 * self.bulk - 2 * self.shear) / (6 * self.bulk + 2 * self.shear)

    @property
    def solid(self):
        return self.shear > 0

    @property
    def sound(self):
        """Longitudinal sound speed, m/s."""
        return math.sqrt((self.bulk + 4 / 3 * self.shear) / self.density)

    def thin(self, geometry):
        """Modulus of a thin bar: E, or E/(1 - nu^2) where the third direction is held; on a line K
        + 4 G/3."""
        if geometry == "1d":
            return self.bulk + 4 / 3 * self.shear
        return self.young / (1 - self.poisson**2) if geometry == "plane-strain" else self.young

    def across(self, geometry):
        """How much a thin bar becomes thinner by its strain along."""
        nu = self.poisson
        return nu / (1 - nu) if geometry == "plane-strain" else nu

    def deviator(self, density, geometry="1d"):
        """Minus the deviator along the axis in uniaxial strain: 4/3 G ln(density/density_0), at
        most 2/3 Y."""
        elastic = 4 / 3 * self.shear * math.log(density / self.density)
        if self.yield_stress:
            elastic = max(-2 / 3 * self.yield_stress, min(2 / 3 * self.yield_stress, elastic))
        return elastic

    def shock(self, speed):
        """The jump to a particle speed SPEED from rest: (stress, shock speed), compression
        positive. With a yield stress an elastic wave runs ahead, and the shock speed is that of the
        plastic wave."""
        density, stress, energy, u, front = self.density, self.pressure, self.energy, 0.0, 0.0
        if self.yield_stress:
            limit = self.density * math.exp(self.yield_stress / (2 * self.shear))
            there = self.pressure_of(limit, 0.0) + self.deviator(limit)
            jump = math.sqrt((there - stress) * (1 / density - 1 / limit))
            if jump < speed:
                front = jump / (1 - density / limit)
                energy += 0.5 * (there + stress) * (1 / density - 1 / limit)
                density, stress, u = limit, there, jump

        def miss(r):
            """What the equation of state lacks of the jump conditions at the density r."""
            v = speed - u
            there = stress + density * v * v * r / (r - density)
            e = energy + 0.5 * (there + stress) * (1 / density - 1 / r)
            return self.pressure_of(r, e) + self.deviator(r) - there

        low, high = density * (1 + 1e-9), density * 1.0001
        while miss(high) < 0:
            low, high = high, density + (high - density) * 1.3
        for _ in range(100):
            r = 0.5 * (low + high)
            low, high = (r, high) if miss(r) < 0 else (low, r)
        wave = u + (speed - u) * high / (high - density)
        if front and wave > front:
            raise ValueError("the plastic wave overtakes the elastic one")
        return stress + density * (speed - u) ** 2 * high / (high - density), wave

    def isentrope(self, ratio):
        """Pressure and energy at density times RATIO, from rest without a shock: de = p/density^2
        ddensity."""
        r, e, n = self.density, self.energy, 2000
        step = (ratio - 1) * self.density / n
        for _ in range(n):  # Heun's method: an error of (ratio - 1)^3/n^2
            first = self.pressure_of(r, e) / r**2
            second = self.pressure_of(r + step, e + step * first) / (r + step) ** 2
            r, e = r + step, e + step * 0.5 * (first + second)
        return self.pressure_of(r, e), e


def barotropic(density, bulk):
    return lambda r, e: bulk * (1 - density / r)


ELASTIC = {"yield": "1e12 Pa"}
RUBBER_E, RUBBER_NU = 10e6, 0.3975
RUBBER_K, RUBBER_G = RUBBER_E / (3 * (1 - 2 * RUBBER_NU)), RUBBER_E / (2 * (1 + RUBBER_NU))
BAROTROPIC = {"barotropic": {"density": "2700 kg/m^3", "bulk_modulus": "73 GPa"}}

# TNT's products, from the density of the explosive: (3-1) of Cui (2014), table 3.1.
A, B, R1, R2, OMEGA, E0, RHO0 = 371.2e9, 3.21e9, 4.15, 0.95, 0.3, 6.993e9, 1630.0


def jwl(r, e):
    v = RHO0 / r
    return (
        A * (1 - OMEGA / (R1 * v)) * math.exp(-R1 * v)
        + B * (1 - OMEGA / (R2 * v)) * math.exp(-R2 * v)
        + OMEGA * (E0 + RHO0 * e) / v
    )


def jwl_bulk():
    """density c^2 at the start: c^2 = dp/d(density) + p/density^2 dp/de."""
    h = 1e-4 * RHO0
    slope = (jwl(RHO0 + h, 0) - jwl(RHO0 - h, 0)) / (2 * h)
    return RHO0 * (slope + jwl(RHO0, 0) / RHO0**2 * OMEGA * RHO0)


ALUMINIUM = {"library": "aluminium", "strength": {"perfect-plastic": ELASTIC}}
RUBBER = {
    "eos": {
        "rubber": {"density": "1000 kg/m^3", "sound": f"{math.sqrt(RUBBER_K / 1000):.12g} m/s"}
    },
    "strength": {"perfect-plastic": {"shear_modulus": f"{RUBBER_G:.12g} Pa", "yield": "1e9 Pa"}},
}
DUCTILE = {
    "eos": {
        "polynomial": {
            "density": "2700 kg/m^3",
            "bulk_modulus": "58.3 GPa",
            "second_modulus": "60.5 GPa",
            "third_modulus": "36.5 GPa",
        }
    },
    "strength": {
        "johnson-cook": {
            "shear_modulus": "26.9 GPa",
            "a": "324.1 MPa",
            "b": "500 MPa",
            "n": 0.5,
            "c": 0,
        }
    },
}
COPPER = {
    "eos": {"barotropic": {"density": "8930 kg/m^3", "bulk_modulus": "130 GPa"}},
    "strength": {
        "johnson-cook": {
            "shear_modulus": "43.3333 GPa",
            "a": "400 MPa",
            "b": "100 MPa",
            "n": 1,
            "c": 0,
        }
    },
}

MATERIALS = {
    # Aluminium of the library that never yields. In compression it is stiffer by 6 % than in
    # tension.
    "aluminium": Material(ALUMINIUM, 2700, 73e9, 23e9),
    # One modulus in tension and compression, for exact answers; elastic, and perfectly plastic.
    "elastic": Material(
        {
            "eos": BAROTROPIC,
            "strength": {"perfect-plastic": {"shear_modulus": "23 GPa", **ELASTIC}},
        },
        2700,
        73e9,
        23e9,
        pressure_of=barotropic(2700, 73e9),
    ),
    "plastic": Material(
        {
            "eos": BAROTROPIC,
            "strength": {"perfect-plastic": {"shear_modulus": "23 GPa", "yield": "0.4 GPa"}},
        },
        2700,
        73e9,
        23e9,
        yield_stress=0.4e9,
        pressure_of=barotropic(2700, 73e9),
    ),
    # The rubber of the rings of Gray, Monaghan and Swift (2001).
    "rubber": Material(
        RUBBER,
        1000,
        RUBBER_K,
        RUBBER_G,
        speed=1.0,
        pressure_of=lambda r, e: RUBBER_K * (r / 1000 - 1),
    ),
    # Aluminium without shear: what holds it in tension is its equation of state alone.
    "fluid": Material({"eos": BAROTROPIC}, 2700, 73e9, pressure_of=barotropic(2700, 73e9)),
    # Ductile and hardening: Y = 324.1 + 500 strain^0.5 MPa.
    "ductile": Material(
        DUCTILE, 2700, 58.3e9, 26.9e9, yield_stress=324.1e6, hardening=(500e6, 0.5)
    ),
    # Copper of Taylor's rod: Y = 400 + 100 strain MPa.
    "copper": Material(COPPER, 8930, 130e9, 43.3333e9, yield_stress=400e6, hardening=(100e6, 1)),
    "water": Material({"library": "water"}, 1000, 2e9, pressure_of=barotropic(1000, 2e9)),
    "gas": Material(
        {"eos": {"ideal-gas": {"density": "1 kg/m^3", "gamma": 1.4}}},
        1.0,
        1.4e5,
        pressure=1e5,
        energy=2.5e5,
        state={"density": "1 kg/m^3", "pressure": "0.1 MPa"},
        pressure_of=lambda r, e: 0.4 * r * e,
    ),
    "products": Material(
        {"library": "tnt-products"},
        RHO0,
        jwl_bulk(),
        pressure=jwl(RHO0, 0),
        state={"density": "1630 kg/m^3", "energy": "0 J/kg"},
        pressure_of=jwl,
    ),
}
