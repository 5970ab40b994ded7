"""Find the Young's modulus of a rope from measured points on it.

The points are made by a simulation with another value, and noise is added to them.
"""

from dataclasses import replace

import numpy as np
from matplotlib.figure import Figure
from output_folder import output_folder
from scipy.optimize import minimize_scalar

from deformable_manipulation.scenario import load_scenario
from deformable_manipulation.simulation.factory import make_simulation

TRUE_MODULUS = 4e8  # Pa
NOISE = 0.002  # m
MARKERS = slice(2, None, 3)  # every third point of the rope is measured

scenario = load_scenario("rope_one_assistant")


def hanging_rope(young_modulus: float) -> np.ndarray:
    """Points (29, 3) [m] of the rope at rest between its holders."""
    rope = replace(scenario.object, young_modulus=young_modulus)
    return make_simulation(replace(scenario, object=rope), copies=False).points()[0]


def mean_square_error(exponent: float) -> float:
    return float(np.mean((hanging_rope(10.0**exponent)[MARKERS] - measured) ** 2))


folder = output_folder(__doc__)
true_shape = hanging_rope(TRUE_MODULUS)
noise = np.random.default_rng(1).normal(0.0, NOISE, true_shape.shape)
measured = (true_shape + noise)[MARKERS]

fit = minimize_scalar(mean_square_error, bounds=(6.0, 10.0), method="bounded")
modulus = 10.0**fit.x
print(f"Young's modulus: {modulus:.3g} Pa found, {TRUE_MODULUS:.3g} Pa true")
print(f"error left: {1e3 * np.sqrt(fit.fun):.2f} mm RMS, noise {1e3 * NOISE:g} mm")

figure = Figure(figsize=(6, 4), layout="constrained")
axes = figure.add_subplot(xlabel="y [m]", ylabel="z [m]", aspect="equal")
axes.plot(*hanging_rope(scenario.object.young_modulus).T[1:], ":", label="the scenario's rope")
axes.plot(*hanging_rope(modulus).T[1:], label="fitted rope")
axes.plot(*measured.T[1:], "k.", label="measured points")
axes.legend()
figure.savefig(folder / "fit_stiffness.png", dpi=150)
