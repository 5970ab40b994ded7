"""The safe velocity controller of one assistant."""

from deformable_manipulation.control.team import TeamController


class AssistantController:
    """Follows the leader at a fixed relative position: a :class:`~.team.TeamController` of one.

    Decentralised: it uses its own observations alone.

    Args:
        scenario: :class:`~deformable_manipulation.scenario.spec.Scenario`.
        agent: name of the assistant.
        safety: False leaves the barriers out: the nominal velocity within its limits.

    Raises:
        ValueError: the scenario has no assistant of that name, or an unusable setting.
    """

    def __init__(self, scenario, agent, safety=True):
        self._name = agent
        self._team = TeamController(scenario, (agent,), safety)

    @property
    def enabled(self):
        """False answers every state with zero velocity."""
        return self._team.is_enabled(self._name)

    @enabled.setter
    def enabled(self, enabled):
        self._team.set_enabled(self._name, enabled)

    def set_parameters(self, scenario):
        """See :meth:`~.team.TeamController.set_parameters`."""
        self._team.set_parameters(scenario)

    def reset(self):
        """See :meth:`~.team.TeamController.reset`."""
        self._team.reset()

    def take_reference(self, observation):
        """See :meth:`~.team.TeamController.take_reference`."""
        self._team.take_reference(self._name, observation)

    def update(self, observation):
        """Its :class:`~.decision.Decision`; see :meth:`~.team.TeamController.update`."""
        return self._team.update(observation)[self._name]

    def wait(self, reason):
        """Its :class:`~.decision.Decision`; see :meth:`~.team.TeamController.wait`."""
        return self._team.wait(reason)[self._name]
