"""The simulation of pyPBD, one for the process."""

import pypbd


class Stepper:
    """An empty model of the library, and its time steps. The library's vertical axis is y."""

    def __init__(self, time_step: float, iterations: int):
        simulation = pypbd.Simulation.getCurrent()
        simulation.initDefault()
        self.model = simulation.getModel()
        self._stepper = simulation.getTimeStep()
        kind = pypbd.TimeStepController
        self._stepper.setValueUInt(kind.NUM_SUB_STEPS, 1)
        self._stepper.setValueUInt(kind.MAX_ITERATIONS, iterations)
        self._stepper.setValueUInt(kind.MAX_ITERATIONS_V, 0)
        pypbd.TimeManager.getCurrent().setTimeStepSize(time_step)

    def advance(self, count: int) -> None:
        """Make a number of time steps."""
        for _ in range(count):
            self._stepper.step(self.model)
