"""The menu with which a run is controlled from RViz."""

import rospy
from interactive_markers.menu_handler import MenuHandler
from std_srvs.srv import SetBool, Trigger

_OF_AN_ASSISTANT = (
    ("Start", "enable", SetBool, (True,)),
    ("Stop", "enable", SetBool, (False,)),
    ("Keep the current place", "take_reference", Trigger, ()),
)
_OF_THE_RUN = (
    ("Pause", "pause", SetBool, (True,)),
    ("Continue", "pause", SetBool, (False,)),
    ("Reset", "reset", Trigger, ()),
)


def run_menu(assistants):
    """A menu of the run's services (docs/interfaces.md); what they answer goes to the log.

    Args:
        assistants: their names.
    """
    menu = MenuHandler()
    groups = [(name, [name]) for name in assistants]
    if len(assistants) > 1:
        groups.append(("All assistants", list(assistants)))
    for title, names in groups:
        parent = menu.insert(title)
        for entry, service, kind, arguments in _OF_AN_ASSISTANT:
            services = [f"{name}/{service}" for name in names]
            menu.insert(entry, parent=parent, callback=_caller(services, kind, arguments))
    for entry, service, kind, arguments in _OF_THE_RUN:
        menu.insert(entry, callback=_caller([service], kind, arguments))
    return menu


def _caller(services, kind, arguments):
    def call(_feedback):
        for service in services:
            _call(service, kind, arguments)

    return call


def _call(service, kind, arguments):
    try:
        answer = rospy.ServiceProxy(service, kind)(*arguments)
    except rospy.ServiceException as error:
        rospy.logwarn(f"Menu: {service} cannot be called: {error}")
        return
    report = rospy.loginfo if answer.success else rospy.logwarn
    report(f"Menu: {service}: {answer.message}")
