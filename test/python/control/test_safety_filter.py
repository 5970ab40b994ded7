import itertools
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import linprog, minimize

from deformable_manipulation import _control
from deformable_manipulation.control.reference_solver import find_solver
from deformable_manipulation.control.status import Status

TOLERANCE = 1e-6  # m/s
LIMIT = 0.15
LIMITS = COLLISION, OVERSTRETCH, PROXIMITY = (0, 1, 2)  # kinds of rows
ANTICIPATION = 3
PRIORITY = LIMITS
LOWER, UPPER = np.full(3, -LIMIT), np.full(3, LIMIT)


class Rows(NamedTuple):
    """Rows of one kind."""

    kind: int
    coefficients: np.ndarray  # (R, n)
    bounds: np.ndarray  # (R,)


class Filtered(NamedTuple):
    velocity: np.ndarray
    status: Status
    slack: dict


class SafetyFilter:
    """The native filter, with rows given by their kinds."""

    def __init__(self, weights, priority=PRIORITY, **settings):
        settings["priority"] = priority
        self._native = _control.SafetyFilter(weights, **settings)

    def filter(self, nominal, parts, lower, upper):
        stack = _control.ConstraintRows(len(nominal))
        for part in parts:
            for coefficients, bound in zip(part.coefficients, part.bounds):
                stack.add(part.kind, coefficients, bound)
        velocity, status, slack = self._native.filter(nominal, stack, lower, upper)
        kinds = (*LIMITS, ANTICIPATION)
        return Filtered(velocity, Status(status), dict(zip(kinds, slack)))


def rows(kind, coefficients, bounds):
    return Rows(
        kind,
        np.atleast_2d(np.array(coefficients, dtype=float)),
        np.atleast_1d(np.array(bounds, dtype=float)),
    )


def random_problem(generator, spread):
    """Nominal velocity and rows of all kinds; the larger the spread, the fewer are feasible."""
    parts = []
    for kind in LIMITS:
        count = generator.integers(1, 4)
        coefficients = generator.normal(size=(count, 3))
        coefficients /= np.linalg.norm(coefficients, axis=1)[:, None]
        parts.append(Rows(kind, coefficients, generator.uniform(-0.1, spread, size=count)))
    return generator.uniform(-0.3, 0.3, size=3), parts


def stacked(parts):
    return (
        np.concatenate([part.coefficients for part in parts]),
        np.concatenate([part.bounds for part in parts]),
    )


def by_enumeration(weights, nominal, A, b):
    """Optimum over every choice of active constraints that satisfies the KKT conditions."""
    A = np.concatenate((A, np.eye(3), -np.eye(3)))
    b = np.concatenate((b, LOWER, -UPPER))
    inverse = np.diag(1.0 / weights**2)
    best, least = None, np.inf
    for count in range(4):
        for active in itertools.combinations(range(len(b)), count):
            N = A[list(active)]
            gram = N @ inverse @ N.T
            if count and np.linalg.cond(gram) > 1e12:
                continue
            multipliers = np.linalg.solve(gram, b[list(active)] - N @ nominal) if count else []
            u = nominal + inverse @ N.T @ multipliers if count else nominal
            cost = np.sum((weights * (u - nominal)) ** 2)
            if (A @ u >= b - 1e-9).all() and cost < least:
                best, least = u, cost
    return best


@pytest.mark.parametrize("seed", range(40))
def test_optimum_of_random_problems(seed):
    generator = np.random.default_rng(seed)
    weights = generator.uniform(0.5, 2.0, size=3)
    nominal, parts = random_problem(generator, spread=0.06)
    result = SafetyFilter(weights).filter(nominal, parts, LOWER, UPPER)
    reference = by_enumeration(weights, nominal, *stacked(parts))
    if reference is None:
        assert result.status == Status.RELAXED
    else:
        assert result.status in (Status.NOMINAL, Status.CONSTRAINED)
        np.testing.assert_allclose(result.velocity, reference, atol=1e-7)
        assert not any(result.slack.values())


def infeasible_problems(count, spread=0.25):
    generator = np.random.default_rng(17)
    while count:
        nominal, parts = random_problem(generator, spread)
        if by_enumeration(np.ones(3), nominal, *stacked(parts)) is None:
            count -= 1
            yield nominal, parts


def yielding(part):
    """Part of its kind's slack that each row yields (docs/mathematics.md)."""
    units = part.coefficients / np.linalg.norm(part.coefficients, axis=1)[:, None]
    against = np.maximum(0.0, -units @ units.T)
    demands = part.bounds / (np.abs(part.coefficients) @ UPPER)
    ratios = np.maximum(1.0, demands)[None, :] / np.maximum(1.0, demands)[:, None]
    contends = demands > -1.0
    parts = 1.0 - against * contends * np.maximum(0.0, 1.0 - ratios)
    return np.maximum(0.1, parts.min(axis=1))


def missing(part, velocity):
    """Slack by which rows are missed, beyond what no velocity in the bounds reaches."""
    reachable = np.minimum(part.bounds, np.abs(part.coefficients) @ UPPER)
    return max(0.0, ((reachable - part.coefficients @ velocity) / yielding(part)).max())


def by_priority(parts):
    """Least slack of each kind, one linear program after the other (strictly lexicographic)."""
    A, b, slack = np.empty((0, 3)), np.empty(0), []
    for part in parts:
        reachable = np.minimum(part.bounds, np.abs(part.coefficients) @ UPPER)
        with_slack = np.column_stack((part.coefficients, yielding(part)))
        fixed = np.column_stack((A, np.zeros(len(b))))
        solution = linprog(
            (0.0, 0.0, 0.0, 1.0),
            A_ub=-np.concatenate((fixed, with_slack)),
            b_ub=-np.concatenate((b, reachable)),
            bounds=[(-LIMIT, LIMIT)] * 3 + [(0.0, None)],
        )
        slack.append(solution.fun)
        A = np.concatenate((A, part.coefficients))
        b = np.concatenate((b, reachable - solution.fun * yielding(part) - 1e-9))
    return slack


def test_priority_of_random_infeasible_problems():
    """As strict as a factor of 100 between the kinds allows: nearly always lexicographic."""
    safety, exact, problems = SafetyFilter(np.ones(3)), 0, 60
    for nominal, parts in infeasible_problems(problems):
        result = safety.filter(nominal, parts, LOWER, UPPER)
        assert result.status == Status.RELAXED
        lost = np.array([missing(part, result.velocity) for part in parts]) - by_priority(parts)
        # Against the lexicographic solution no more can be won than by tracking at its steepest,
        # over the widest change of each component.
        assert lost @ (1e6, 1e4, 1e2) <= 3 * 2 * LIMIT
        exact += np.abs(lost).max() < 1e-5
        for part in parts:
            short = max(0.0, (part.bounds - part.coefficients @ result.velocity).max())
            assert result.slack[part.kind] == pytest.approx(short, abs=TOLERANCE)
    assert exact >= 0.95 * problems


@pytest.mark.parametrize("weights", [(1.0, 1.0, 1.0), (1.0, 0.1, 10.0)])
@pytest.mark.parametrize("scale", [1.0, 1e3])
def test_badly_scaled_rows_and_far_nominal_velocities_are_solved(weights, scale):
    generator, safety = np.random.default_rng(21), SafetyFilter(weights)
    for _ in range(100):
        nominal, parts = random_problem(generator, 0.25)
        parts = [
            Rows(
                p.kind,
                p.coefficients * 10.0 ** generator.uniform(-5, 1, (len(p.bounds), 1)),
                p.bounds,
            )
            for p in parts
        ]
        centre = generator.uniform(-0.14, 0.14, 3)
        result = safety.filter(scale * nominal, parts, centre - 0.01, centre + 0.01)
        assert result.status != Status.FAILED


def nearest(nominal, start, A, b):
    """Least squared departure from the nominal velocity subject to A u >= b and the bounds."""
    return minimize(
        lambda u: 0.5 * np.sum((u - nominal) ** 2),
        start,
        jac=lambda u: u - nominal,
        method="SLSQP",
        bounds=[(-LIMIT, LIMIT)] * 3,
        constraints={"type": "ineq", "fun": lambda u: A @ u - b, "jac": lambda u: A},
    ).fun


def test_tracks_as_well_as_the_relaxed_constraints_allow():
    safety = SafetyFilter(np.ones(3))
    for nominal, parts in infeasible_problems(10):
        result = safety.filter(nominal, parts, LOWER, UPPER)
        A, b = stacked(parts)
        slack = np.concatenate([missing(part, result.velocity) * yielding(part) for part in parts])
        limits = np.minimum(b, np.abs(A) @ UPPER) - slack - 1e-9
        cost = 0.5 * np.sum((result.velocity - nominal) ** 2)
        assert cost <= nearest(nominal, result.velocity, A, limits) + 1e-6


def test_collision_outranks_overstretch_outranks_proximity():
    forward, back = [1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]
    safety = SafetyFilter(np.ones(3))
    for high, low in itertools.combinations(LIMITS, 2):
        parts = [rows(low, back, 0.05), rows(high, forward, 0.1)]
        result = safety.filter(np.zeros(3), parts, LOWER, UPPER)
        np.testing.assert_allclose(result.velocity, [0.1, 0.0, 0.0], atol=1e-8)
        assert result.slack[low] == pytest.approx(0.15)
        assert result.slack[high] == 0.0


@pytest.mark.parametrize("priority", list(itertools.permutations(PRIORITY)))
def test_the_priority_is_the_users(priority):
    safety = SafetyFilter(np.ones(3), priority=list(priority))
    kinds = list(priority)
    for high, low in itertools.combinations(kinds, 2):
        parts = [rows(low, [-1.0, 0.0, 0.0], 0.05), rows(high, [1.0, 0.0, 0.0], 0.1)]
        result = safety.filter(np.zeros(3), parts, LOWER, UPPER)
        np.testing.assert_allclose(result.velocity, [0.1, 0.0, 0.0], atol=1e-8)
        assert result.slack[high] == 0.0 < result.slack[low]


@pytest.mark.parametrize(
    "priority",
    [
        [0, 2],
        [0, 0, 0],
        [0, 1, 3],
        [0, 1, -1],
    ],
)
def test_a_priority_is_an_order_of_the_limits(priority):
    with pytest.raises(ValueError, match="priority"):
        SafetyFilter(np.ones(3), priority=priority)


def test_anticipation_pulls_and_gives_way_to_every_limit():
    wish = rows(ANTICIPATION, [1.0, 0.0, 0.0], 0.11)
    safety = SafetyFilter(np.ones(3))
    pulled = safety.filter(np.zeros(3), [wish], LOWER, UPPER)
    # 1/2 u^2 + 10/2 (0.11 - u)^2 is least at 0.1.
    np.testing.assert_allclose(pulled.velocity, [0.1, 0.0, 0.0], atol=1e-8)
    assert pulled.status == Status.CONSTRAINED
    assert pulled.slack[ANTICIPATION] == pytest.approx(0.01)
    for kind in LIMITS:
        against = rows(kind, [-1.0, 0.0, 0.0], 0.02)
        result = safety.filter(np.zeros(3), [wish, against], LOWER, UPPER)
        np.testing.assert_allclose(result.velocity, [-0.02, 0.0, 0.0], atol=1e-8)
        assert result.status == Status.CONSTRAINED


def test_without_relaxation_contradicting_rows_fail():
    """The paper's program."""
    parts = [rows(COLLISION, [[1, 0, 0], [-1, 0, 0]], [0.1, 0.02])]
    safety = SafetyFilter(np.ones(3), relaxation=False)
    result = safety.filter(np.zeros(3), parts, LOWER, UPPER)
    assert result.status == Status.FAILED
    np.testing.assert_array_equal(result.velocity, 0.0)
    generator = np.random.default_rng(5)
    for _ in range(200):
        nominal, parts = random_problem(generator, 0.06)
        result = safety.filter(nominal, parts, LOWER, UPPER)
        reference = by_enumeration(np.ones(3), nominal, *stacked(parts))
        if reference is None:
            assert result.status == Status.FAILED
        else:
            np.testing.assert_allclose(result.velocity, reference, atol=1e-7)


def test_several_assistants_in_one_program():
    """Nine velocities, as many rows as three ropes near the ground have."""
    generator = np.random.default_rng(11)
    native = SafetyFilter(np.ones(9))
    reference = SafetyFilter(np.ones(9), solver=find_solver("quadprog"))
    for _ in range(30):
        parts = [
            rows(kind, generator.normal(size=(count, 9)), 0.2 * generator.normal(size=count))
            for kind, count in ((COLLISION, 60), (OVERSTRETCH, 6))
        ]
        given = generator.uniform(-0.3, 0.3, 9), parts, np.full(9, -LIMIT), np.full(9, LIMIT)
        ours, theirs = native.filter(*given), reference.filter(*given)
        assert ours.status == theirs.status
        np.testing.assert_allclose(ours.velocity, theirs.velocity, atol=1e-7)


@pytest.mark.parametrize("direction", range(3))
def test_the_command_is_continuous_where_limits_begin_to_contradict(direction):
    """No jump between the constrained and the relaxed solution, nor anywhere around."""
    safety = SafetyFilter(np.ones(3))
    axis = np.eye(3)[direction]
    tilted = axis + 0.3 * np.eye(3)[direction - 1]
    velocities = []
    for bound in np.linspace(-0.1, 0.1, 401):
        parts = [rows(COLLISION, tilted, 0.02), rows(OVERSTRETCH, -axis, bound)]
        result = safety.filter(np.full(3, 0.05), parts, LOWER, UPPER)
        velocities.append(result.velocity)
    assert np.abs(np.diff(velocities, axis=0)).max() < 10 * 0.2 / 400


def test_the_worst_row_of_a_kind_is_relieved_as_far_as_possible():
    parts = [rows(COLLISION, [[1, 0, 0], [-1, 0, 0]], [0.1, 0.02])]
    result = SafetyFilter(np.ones(3)).filter(np.zeros(3), parts, LOWER, UPPER)
    np.testing.assert_allclose(result.velocity, [0.04, 0.0, 0.0], atol=1e-8)
    assert result.slack[COLLISION] == pytest.approx(0.06)


@pytest.mark.parametrize("hopeless", [[0.0, 0.0, 0.0], [1e-9, 0.0, 0.0], [5e-4, 0.0, -4e-4]])
def test_a_row_beyond_the_agents_influence_does_not_hamper_the_others(hopeless):
    nominal = np.array([0.1, 0.0, -0.1])
    helpful = rows(COLLISION, [0.0, 0.0, 1.0], -0.03)
    safety = SafetyFilter(np.ones(3))
    alone = safety.filter(nominal, [helpful], LOWER, UPPER)
    both = safety.filter(nominal, [rows(COLLISION, hopeless, 0.4), helpful], LOWER, UPPER)
    np.testing.assert_allclose(both.velocity, alone.velocity, atol=1e-8)
    assert both.status == Status.RELAXED
    assert both.slack[COLLISION] == pytest.approx(0.4, abs=1e-3)


def test_a_row_out_of_reach_takes_all_it_can_get():
    parts = [rows(COLLISION, [0.0, 0.0, 0.5], 2.0)]
    result = SafetyFilter(np.ones(3)).filter(np.array([0.1, 0.0, 0.0]), parts, LOWER, UPPER)
    np.testing.assert_allclose(result.velocity, [0.1, 0.0, LIMIT], atol=1e-8)
    assert result.slack[COLLISION] == pytest.approx(2.0 - 0.5 * LIMIT)


@pytest.mark.parametrize("one, other", [(0.06, 0.03), (0.03, 0.06), (0.3, 0.06), (0.4, 0.4)])
def test_rows_out_of_reach_that_contradict_come_to_share_what_both_miss(one, other):
    """Not held at the velocity that they met at, which is in the middle of what a cycle allows."""
    safety, step = SafetyFilter(np.ones(3)), 0.01
    parts = [rows(PROXIMITY, [[1, 0, 0], [-1, 0, 0]], [one, other])]
    velocity, steps = np.zeros(3), []
    for _ in range(200):
        lower, upper = np.maximum(velocity - step, LOWER), np.minimum(velocity + step, UPPER)
        last, velocity = velocity, safety.filter(np.zeros(3), parts, lower, upper).velocity
        steps.append(velocity[0] - last[0])
    fair = 0.5 * (one - other)
    np.testing.assert_allclose(velocity, [fair, 0.0, 0.0], atol=1e-4)
    assert (np.sign(fair) * np.array(steps) >= -1e-9).all()  # without going back and forth


@pytest.mark.parametrize("angle", [180.0, 150.0, 100.0])
def test_the_command_is_continuous_where_rows_of_a_limit_contradict(angle):
    safety, step = SafetyFilter(np.ones(3)), 0.01
    turned = [np.cos(np.radians(angle)), np.sin(np.radians(angle)), 0.0]
    velocities = []
    for bound in np.linspace(-0.04, 0.06, 401):
        parts = [rows(PROXIMITY, [[1, 0, 0], turned], [0.05, bound])]
        result = safety.filter(np.full(3, 0.002), parts, np.full(3, -step), np.full(3, step))
        velocities.append(result.velocity)
    assert np.abs(np.diff(velocities, axis=0)).max() < 10 * 0.1 / 400


finite = st.floats(-1e3, 1e3)


@settings(max_examples=150, deadline=None)
@given(
    st.lists(st.tuples(st.sampled_from(LIMITS), finite, finite, finite, finite), max_size=12),
    st.tuples(finite, finite, finite),
    st.tuples(st.floats(0.0, LIMIT), st.floats(0.0, LIMIT), st.floats(0.0, LIMIT)),
)
def test_bounds_always_hold(parts, nominal, half):
    parts = [rows(kind, [x, y, z], b) for kind, x, y, z, b in parts]
    upper = np.array(half)
    result = SafetyFilter(np.ones(3)).filter(np.array(nominal), parts, -upper, upper)
    assert np.isfinite(result.velocity).all()
    assert (np.abs(result.velocity) <= upper).all()
    assert result.status != Status.FAILED
    if result.status in (Status.NOMINAL, Status.CONSTRAINED):
        for part in parts:
            assert (part.coefficients @ result.velocity >= part.bounds - 1e-5).all()


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("place", ["nominal", "coefficients", "bounds", "lower", "upper"])
def test_what_is_not_finite_gives_zero(value, place):
    given = {
        "nominal": np.array([0.1, 0.0, 0.0]),
        "coefficients": np.eye(3),
        "bounds": np.zeros(3),
        "lower": LOWER.copy(),
        "upper": UPPER.copy(),
    }
    given[place].flat[1] = value
    parts = [Rows(COLLISION, given["coefficients"], given["bounds"])]
    with np.errstate(invalid="ignore"):
        result = SafetyFilter(np.ones(3)).filter(
            given["nominal"], parts, given["lower"], given["upper"]
        )
    assert result.status == Status.FAILED
    np.testing.assert_array_equal(result.velocity, 0.0)


@pytest.mark.parametrize(
    "answer", [None, np.full(7, np.nan), np.full(7, 0.2), np.zeros(7), np.zeros(3)]
)
def test_an_invalid_answer_of_the_solver_is_never_a_command(answer):
    safety = SafetyFilter(np.ones(3), solver=lambda P, q, A, b: answer)
    parts = [rows(COLLISION, [1.0, 0.0, 0.0], 0.1)]
    result = safety.filter(np.array([0.05, 0.0, 0.0]), parts, LOWER, UPPER)
    assert result.status == Status.FAILED
    np.testing.assert_array_equal(result.velocity, 0.0)


def test_nominal_passes_where_nothing_is_in_the_way():
    result = SafetyFilter(np.ones(3)).filter(np.array([0.1, 0.0, 0.0]), [], LOWER, UPPER)
    assert result.status == Status.NOMINAL
    np.testing.assert_array_equal(result.velocity, [0.1, 0.0, 0.0])
    clipped = SafetyFilter(np.ones(3)).filter(np.array([0.4, 0.0, 0.0]), [], LOWER, UPPER)
    assert clipped.status == Status.CONSTRAINED
    np.testing.assert_array_equal(clipped.velocity, [LIMIT, 0.0, 0.0])


@pytest.mark.parametrize("spread", [0.06, 0.3])
def test_a_reference_solver_gives_the_same(spread):
    generator = np.random.default_rng(4)
    native = SafetyFilter(np.ones(3))
    reference = SafetyFilter(np.ones(3), solver=find_solver("quadprog"))
    for _ in range(100):
        nominal, parts = random_problem(generator, spread)
        ours = native.filter(nominal, parts, LOWER, UPPER)
        theirs = reference.filter(nominal, parts, LOWER, UPPER)
        assert ours.status == theirs.status
        np.testing.assert_allclose(ours.velocity, theirs.velocity, atol=1e-8)


def test_unknown_solver_names_those_installed():
    with pytest.raises(ValueError, match="controller.solver: 'simplex'.*quadprog"):
        find_solver("simplex")


@pytest.mark.parametrize("weights", [(1.0, 0.0, 1.0), (1.0, np.nan, 1.0), ()])
def test_weights_have_to_be_positive(weights):
    with pytest.raises(ValueError, match="controller.weights"):
        SafetyFilter(weights)


@pytest.mark.parametrize("scale", [1e-100, 1e-4, 1e4, 1e100])
def test_only_the_ratios_of_the_weights_matter(scale):
    generator = np.random.default_rng(7)
    for _ in range(20):
        nominal, parts = random_problem(generator, 0.3)
        wanted = SafetyFilter((1.0, 2.0, 3.0)).filter(nominal, parts, LOWER, UPPER)
        scaled = SafetyFilter((scale, 2.0 * scale, 3.0 * scale)).filter(
            nominal, parts, LOWER, UPPER
        )
        assert scaled.status == wanted.status
        np.testing.assert_allclose(scaled.velocity, wanted.velocity, atol=1e-9)


def test_constraints_that_meet_in_one_point_do_not_go_round_for_ever():
    generator = np.random.default_rng(3)
    values = np.array([0.0, 0.0, 1.0, -1.0, 1e3, -1e3, 1e-3, 0.5, 2.0, 1e-6])
    safety_filter = SafetyFilter(np.ones(3))
    for _ in range(1000):
        parts = [
            rows(generator.choice(LIMITS), generator.choice(values, 3), generator.choice(values))
            for _ in range(generator.integers(13))
        ]
        upper = generator.choice([0.0, 1e-9, 0.01, LIMIT], 3)
        result = safety_filter.filter(generator.choice(values, 3), parts, -upper, upper)
        assert (np.abs(result.velocity) <= upper).all()
        assert result.status != Status.FAILED
