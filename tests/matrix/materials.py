"""The material classes of the matrix, with the constants that its exact answers need.

Elastic constants follow from K and G of the material as the case has them: E = 9 K G/(3 K + G) and
nu = (3 K - 2 G)/(6 K + 2 G). A fluid has G = 0."""
import math


class Material:
    def __init__(self, case, density, bulk, shear=0.0, speed=10.0, **more):
        self.case, self.density, self.bulk, self.shear = case, density, bulk, shear
        self.speed = speed  # of a gentle motion, m/s: strains of a thousandth to a hundredth
        self.yield_stress = more.get("yield_stress")
        self.hardening = more.get("hardening")  # B and n of Y = yield_stress + B strain^n
        self.gamma = more.get("gamma")
        self.energy_at_rest = more.get("energy")
        self.pressure = more.get("pressure", 0.0)  # that a fluid without free surfaces has at rest

    @property
    def young(self):
        return 9 * self.bulk * self.shear / (3 * self.bulk + self.shear)

    @property
    def poisson(self):
        return (3 * self.bulk - 2 * self.shear) / (6 * self.bulk + 2 * self.shear)

    @property
    def sound(self):
        """Longitudinal sound speed, m/s."""
        return math.sqrt((self.bulk + 4 / 3 * self.shear) / self.density)

    def thin(self, geometry):
        """Modulus of a thin bar: E, or E/(1 - nu^2) where the third direction is held."""
        return self.young / (1 - self.poisson**2) if geometry == "plane-strain" else self.young


ELASTIC = {"yield": "1e12 Pa"}
RUBBER_E, RUBBER_NU = 10e6, 0.3975
RUBBER_K, RUBBER_G = RUBBER_E / (3 * (1 - 2 * RUBBER_NU)), RUBBER_E / (2 * (1 + RUBBER_NU))

MATERIALS = {
    # Aluminium of the library that never yields.
    "aluminium": Material(
        {"library": "aluminium", "strength": {"perfect-plastic": ELASTIC}}, 2700, 73e9, 23e9
    ),
    # The rubber of the rings of Gray, Monaghan and Swift (2001).
    "rubber": Material(
        {
            "eos": {
                "rubber": {
                    "density": "1000 kg/m^3",
                    "sound": f"{math.sqrt(RUBBER_K / 1000):.12g} m/s",
                }
            },
            "strength": {
                "perfect-plastic": {"shear_modulus": f"{RUBBER_G:.12g} Pa", "yield": "1e9 Pa"}
            },
        },
        1000,
        RUBBER_K,
        RUBBER_G,
        speed=1.0,
    ),
    # Aluminium without shear: what holds it in tension is its equation of state alone.
    "fluid": Material(
        {"eos": {"barotropic": {"density": "2700 kg/m^3", "bulk_modulus": "73 GPa"}}}, 2700, 73e9
    ),
    # Ductile and hardening: Y = 324.1 + 500 strain^0.5 MPa.
    "ductile": Material(
        {
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
        },
        2700,
        58.3e9,
        26.9e9,
        yield_stress=324.1e6,
        hardening=(500e6, 0.5),
    ),
    # Copper of Taylor's rod: Y = 400 + 100 strain MPa.
    "copper": Material(
        {
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
        },
        8930,
        130e9,
        43.3333e9,
        yield_stress=400e6,
        hardening=(100e6, 1),
    ),
    "gas": Material(
        {"eos": {"ideal-gas": {"density": "1 kg/m^3", "gamma": 1.4}}},
        1.0,
        1.4e5,
        gamma=1.4,
        pressure=1e5,
    ),
}
