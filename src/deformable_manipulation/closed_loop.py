"""The whole chain in one process, without ROS: leader, simulation, distances, controllers."""

import time

from deformable_manipulation.control.controller import AssistantController
from deformable_manipulation.control.observation import Observation
from deformable_manipulation.distance.minimum_distance import MinimumDistance
from deformable_manipulation.leader import LeaderController
from deformable_manipulation.obstacle_motion import MovingObstacles
from deformable_manipulation.recording.timeseries import CycleRecord, CycleTimings
from deformable_manipulation.scenario.spec import Scenario
from deformable_manipulation.simulation import make_simulation
from deformable_manipulation.stretch import StretchGauge

_PROGRESS_REPORTS = 100


class ClosedLoop:
    """Runs a scenario in lock-step: the same order and delay as the nodes (docs/interfaces.md).

    In cycle k all controllers answer state k, the simulation advances to state k + 1 with the
    commands of cycle k - 1, and then takes the new ones. Obstacles move along the scenario's paths;
    those whose poses come from a topic or from tf stand where the scenario puts them.

    Raises _pbd.ParameterError: a parameter of the scenario is out of the simulation's range.
    """

    def __init__(self, scenario: Scenario, safety: bool = True):
        self._scenario = scenario
        # Without barriers nobody asks for gradients.
        self._simulation = make_simulation(scenario, copies=safety)
        self._distance = make_minimum_distance(scenario)
        self._obstacles = MovingObstacles(scenario)
        self._leader = LeaderController(scenario)
        self._leader_index = scenario.leader_index
        self._controllers = {
            index: AssistantController(scenario, scenario.agents[index].name, safety)
            for index in scenario.assistants
        }
        self._points = self._simulation.points()
        self._stretch = StretchGauge(scenario.object)

    def distance(self) -> float:
        """Present signed distance [m] of the object from the obstacles; infinite without any."""
        self._obstacles.move(self._distance, self._simulation.time)
        return float(self._distance.compute(self._simulation.points()[:1]).minimum[0])

    def run(self, recorder=None, progress=None) -> None:
        """Run the scenario to its end.

        ``recorder`` gets a :class:`CycleRecord` per cycle; ``progress`` is called about a hundred
        times with the fraction done.

        Raises _pbd.NonFiniteState: the simulation broke down; what happened is in the text.
        """
        cycles = self._scenario.cycles
        report_every = max(1, cycles // _PROGRESS_REPORTS)
        for cycle in range(cycles):
            record = self.step()
            if recorder is not None:
                recorder.record(record)
            if progress is not None and (cycle + 1) % report_every == 0:
                progress((cycle + 1) / cycles)

    def step(self) -> CycleRecord:
        """Answer the present state and advance to the next one."""
        simulation = self._simulation
        started = time.perf_counter()
        observation = self._observe()
        measured = time.perf_counter()
        decisions = {
            index: controller.update(observation) for index, controller in self._controllers.items()
        }
        leader = self._leader_index
        leader_velocity = self._leader.update(observation.time, observation.positions[leader])
        decided = time.perf_counter()
        velocities = simulation.velocities()
        points = self._points[0].copy()

        advancing = time.perf_counter()
        simulation.advance()
        simulation.set_command(leader, leader_velocity)
        for index, decision in decisions.items():
            simulation.set_command(index, decision.command)
        advanced = time.perf_counter()

        return CycleRecord(
            cycle=observation.cycle,
            time=observation.time,
            distance=float(observation.distances.minimum[0]),
            stretch=self._stretch.measure(points),
            positions=observation.positions,
            velocities=velocities,
            points=points,
            obstacles=self._obstacles.poses(),
            decisions={
                self._scenario.agents[index].name: decision for index, decision in decisions.items()
            },
            timings=CycleTimings(
                simulation=advanced - advancing,
                distance=measured - started,
                controller=decided - measured,
            ),
        )

    def _observe(self) -> Observation:
        simulation = self._simulation
        points = simulation.points(out=self._points)
        self._obstacles.move(self._distance, simulation.time)
        return Observation(
            time=simulation.time,
            cycle=simulation.cycle,
            positions=simulation.positions(),
            points=points,
            displaced_agents=simulation.displaced_agents(),
            displacements=simulation.displacements(),
            ready=simulation.ready(),
            distances=self._distance.compute(points),
            sensitivities=self._sensitivities(),
        )

    def _sensitivities(self):
        """Exact response of the object, where it is wanted and known; else None."""
        if self._scenario.controller.jacobian != "equilibrium":
            return None
        response = self._simulation.response()
        return None if isinstance(response, str) else response


def make_minimum_distance(scenario: Scenario):
    """The distance computation for a scenario's object and obstacles, by the chosen backend.

    Raises ValueError: an obstacle's file cannot be read, or its shape is none.
    """
    body, collision = scenario.object, scenario.controller.collision
    backend = MinimumDistance
    if collision.backend == "reference":
        from deformable_manipulation.distance.reference import ReferenceMinimumDistance

        backend = ReferenceMinimumDistance
    return backend(scenario.obstacles, body.margin, collision.band, "elements", body.triangles)
