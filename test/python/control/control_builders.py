"""Scenarios and observations for the controller's tests, without an object simulator."""

import numpy as np

from deformable_manipulation import _control
from deformable_manipulation.control.observation import Observation
from deformable_manipulation.control.team import TeamController
from deformable_manipulation.distance.features import Distances
from deformable_manipulation.objects.rod import RodSpec
from deformable_manipulation.scenario.spec import (
    AgentSpec,
    CollisionSpec,
    ControllerSpec,
    HorizonSpec,
    LeaderSpec,
    OverstretchSpec,
    ProximitySpec,
    Scenario,
    SimulationSpec,
    Waypoint,
)

SEGMENTS = 28


def scenario(assistants=1, waypoints=((0.0, (0.0, 0.0, 0.0)),), **controller):
    """A rope whose leader starts at (0, 0, 1) and whose last assistant starts at (0, 1.5, 1)."""
    leader_start, last_start = np.array([[0.0, 0.0, 1.0], [0.0, 1.5, 1.0]])
    agents = [AgentSpec("leader", 0, "leader", start=tuple(leader_start))]
    for i in range(1, assistants + 1):
        share = i / assistants
        position = (1.0 - share) * leader_start + share * last_start
        particle = round(share * (SEGMENTS - 1))
        agents.append(AgentSpec(f"assistant_{i}", particle, "assistant", start=tuple(position)))
    settings = dict(
        collision=CollisionSpec(offset=0.05),
        overstretch=OverstretchSpec(max_distance=2.0),
        proximity=ProximitySpec(min_distance=0.2),
        horizon=HorizonSpec(length=0.0),  # the present cycle alone; test_horizon.py looks ahead
    )
    settings.update(controller)
    return Scenario(
        name="test",
        object=RodSpec(2.25, 0.0035, 1792.89, SEGMENTS, 3e7, 1e7),
        agents=tuple(agents),
        obstacles=(),
        leader=LeaderSpec(tuple(Waypoint(time, position) for time, position in waypoints)),
        controller=ControllerSpec(**settings),
        simulation=SimulationSpec(duration=1.0),
    )


class Alone:
    """A controller of one assistant, which is named once."""

    def __init__(self, scenario, name="assistant_1", safety=True):
        self.team = TeamController(scenario, (name,), safety)
        self._name = name

    def update(self, observation):
        """Its Decision."""
        return self.team.update(observation)[self._name]

    def take_reference(self, observation):
        self.team.take_reference(self._name, observation)

    def wait(self, reason):
        """Its Decision where an input is missing."""
        return self.team.wait(reason)[self._name]

    def enable(self, enabled):
        self.team.set_enabled(self._name, enabled)


class LinearObject:
    """An object whose points depend linearly on the held points.

    ``points = rest + sum over agents S_a x_a`` with sum S_a = I, so that moving all held points
    together moves it rigidly.
    """

    def __init__(self, sensitivities, rest):
        self.sensitivities = sensitivities  # (A, P, 3, 3)
        self.rest = rest  # (P, 3)

    def points(self, positions):
        return self.rest + np.einsum("apij,aj->pi", self.sensitivities, positions)


def hanging_chain(agents, sag, points=21):
    """A chain between the first and the last agent, linear in between but for a fixed sag.

    Inner agents hold their point of it only as far as hat functions reach.
    """
    s = np.linspace(0.0, 1.0, points)
    knots = np.linspace(0.0, 1.0, agents)
    weights = np.array([np.interp(s, knots, np.eye(agents)[a]) for a in range(agents)])
    rest = np.zeros((points, 3))
    rest[:, 2] = -4.0 * sag * s * (1.0 - s)
    return LinearObject(weights[:, :, None, None] * np.eye(3), rest)


def random_object(generator, agents, points=6):
    """A linear object of random sensitivities; the first agent's make them sum to one."""
    sensitivities = generator.normal(size=(agents, points, 3, 3))
    sensitivities[0] = np.eye(3) - sensitivities[1:].sum(axis=0)
    return LinearObject(sensitivities, generator.normal(size=(points, 3)))


class HalfSpace:
    """An obstacle that fills ``normal . x <= level(t)``, moving with a velocity."""

    def __init__(self, normal, level, velocity=(0.0, 0.0, 0.0)):
        self.normal = np.asarray(normal, dtype=float)
        self.level = level
        self.velocity = np.asarray(velocity, dtype=float)

    def at(self, seconds):
        """The same obstacle, ``seconds`` later."""
        moved = self.level + seconds * self.normal @ self.velocity
        return HalfSpace(self.normal, moved, self.velocity)

    def distances(self, points, band=0.1):
        """Distances of the copies (C, P, 3): each point within the band is a feature."""
        depth = points @ self.normal - self.level
        order = [np.argsort(row, kind="stable") for row in depth]
        near = [o[row[o] <= row.min() + band] for o, row in zip(order, depth)]
        copy = np.repeat(np.arange(len(points)), [len(n) for n in near])
        vertex = np.concatenate(near)
        distance = depth[copy, vertex]
        count = len(vertex)
        return Distances(
            minimum=depth.min(axis=1),
            offsets=np.concatenate(([0], np.cumsum([len(n) for n in near]))),
            distance=distance,
            obstacle=np.zeros(count, dtype=int),
            object_point=points[copy, vertex],
            obstacle_point=points[copy, vertex] - distance[:, None] * self.normal,
            normal=np.tile(self.normal, (count, 1)),
            vertices=np.stack((vertex, vertex * 0, vertex * 0), axis=1),
            weights=np.tile((1.0, 0.0, 0.0), (count, 1)),
            obstacle_velocity=np.tile(self.velocity, (count, 1)),
            identity=vertex,
        )


def team(commanded, assistants, agents, formulation, max_velocity=0.15, **turning):
    """Who is commanded; agent 0 leads."""
    return _control.Team(
        agents=agents,
        leader=0,
        assistants=list(assistants),
        commanded=list(commanded),
        max_velocity=max_velocity,
        formulation=formulation,
        **turning,
    )


class PairBarrier:
    """The native barrier between pairs of agents, with its values and gradients pair by pair."""

    _UNLIMITED = {"overstretch": 1e9, "proximity": -1e9}

    def __init__(self, kind, commanded, limits, alpha, margin=0.0, shares=True):
        self._kind, self._limits = kind, np.asarray(limits)
        self._settings = {"alpha": list(alpha), "margin": margin}
        formulation = _control.Formulation.full()
        formulation.shares = shares
        agents = len(self._limits)
        self._team = team(commanded, range(1, agents), agents, formulation)
        self._native = self._with(self._limits)

    def _with(self, limits):
        return _control.Barrier(self._kind, {**self._settings, "limits": limits}, self._team)

    def value(self, positions, agent, other):
        """h [m] of a pair: the lowest of an agent when no other pair is limited."""
        limits = np.full_like(self._limits, self._UNLIMITED[self._kind])
        limits[agent, other] = limits[other, agent] = self._limits[agent, other]
        return self._with(limits).value(positions, np.inf, agent)

    def lowest(self, positions, agent):
        return self._native.value(positions, np.inf, agent)

    def gradient(self, positions, agent, other):
        """dh / d held point of the agent, from the row that it alone is commanded by."""
        alone = team([agent], range(1, len(self._limits)), len(self._limits), self._formulation())
        native = _control.Barrier(self._kind, {**self._settings, "limits": self._limits}, alone)
        state = _control.PredictedState(positions, np.zeros_like(positions))
        others = [index for index in range(len(self._limits)) if index != agent]
        return native.rows(NO_FEATURES, state).coefficients[others.index(other)]

    @staticmethod
    def _formulation():
        return _control.Formulation.full()

    def rows(self, state):
        return self._native.rows(NO_FEATURES, state)


NO_FEATURES = _control.Features(
    np.zeros(0), np.zeros((0, 3)), np.zeros((0, 3)), np.zeros((0, 2, 3))
)


def collision_barrier(commanded, assistants, formulation, **settings):
    """The native collision barrier; settings replace those of its section."""
    parameters = {
        "alpha": [1.0, 5.0],
        "anticipation": [0.4, 5.0],
        "band": 0.1,
        "margin": 0.0,
        "offset": 0.05,
        "speed_margin": 0.0,
        "snap_margin": 0.0,
        **settings,
    }
    members = team(commanded, assistants, len(assistants) + 1, formulation)
    return _control.Barrier("collision", parameters, members)


def no_distances(copies):
    """Distances where there is no obstacle."""
    return Distances(
        minimum=np.full(copies, np.inf),
        offsets=np.zeros(copies + 1, dtype=int),
        distance=np.empty(0),
        obstacle=np.empty(0, dtype=int),
        object_point=np.empty((0, 3)),
        obstacle_point=np.empty((0, 3)),
        normal=np.empty((0, 3)),
        vertices=np.empty((0, 3), dtype=int),
        weights=np.empty((0, 3)),
        obstacle_velocity=np.empty((0, 3)),
    )


def axis_copies(agents, size=0.1, leader=0):
    """Displaced agents and displacements of one copy per axis of each assistant; copy 0 first."""
    displaced, displacements = [-1], [np.zeros(3)]
    for agent in range(agents):
        if agent != leader:
            displaced += [agent] * 3
            displacements += list(size * np.eye(3))
    return np.array(displaced), np.array(displacements)


def observe(time, positions, body, obstacle, copies=None, ready=None, cycle=0):
    """The observation of an object held at ``positions`` (A, 3)."""
    displaced, displacements = axis_copies(len(positions)) if copies is None else copies
    points = []
    for agent, displacement in zip(displaced, displacements):
        held = positions.copy()
        if agent >= 0:
            held[agent] += displacement
        points.append(body.points(held))
    points = np.array(points)
    return Observation(
        time=time,
        cycle=cycle,
        positions=positions,
        points=points,
        displaced_agents=displaced,
        displacements=displacements,
        ready=np.ones(len(displaced), dtype=bool) if ready is None else ready,
        distances=obstacle.distances(points) if obstacle else no_distances(len(points)),
    )
