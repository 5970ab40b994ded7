"""Every block of measured numbers: its page, the command that measures it and the code it is of."""

from dataclasses import dataclass
from typing import Callable, Dict, Optional, Sequence, Tuple

from deformable_manipulation.benchmarks.subject import SUBJECTS
from deformable_manipulation.figures import (
    announcements,
    campaigns,
    fast_leaders,
    scenarios,
    seen,
    worlds,
)
from deformable_manipulation.figures.runs import Say

README = "README.md"
RESULTS = "docs/results.md"
SAFETY = "docs/safety.md"
REAL_OBJECTS = "docs/real_objects.md"
VALIDATION = "docs/validation.md"
BENCHMARKS = "docs/benchmarks.md"

_PYTHON = "src/deformable_manipulation"
# Parts of the Python package that a run without ROS does not depend on.
_OTHER_PARTS = (
    *("authoring", "benchmarks", "campaign", "commands", "figures", "plots", "recording"),
    *("reproduction", "ros", "validation"),
)


def _sources(*extra: str, parts: Sequence[str] = ()) -> Tuple[str, ...]:
    """Git pathspecs of the simulation and its controllers, some other parts and further paths."""
    left_out = [f":(exclude){_PYTHON}/{part}" for part in _OTHER_PARTS if part not in parts]
    core = ("src", "include", "config/scenarios", "config/materials")
    native = () if "ros" in parts else (":(exclude)src/ros",)
    return (*core, *extra, *left_out, *native)


CLOSED_LOOP = _sources()
CAMPAIGNS = _sources(parts=["campaign"])
NODES = _sources("nodes", "launch", "msg", parts=["ros"])
THEORY = ("src/pbd", "src/python", "include/deformable_manipulation/pbd", f"{_PYTHON}/validation")
Measure = Callable[[Say], Dict[str, str]]


@dataclass(frozen=True)
class Subject:
    """A block, or blocks that are measured together."""

    pages: Dict[str, str]  # name of the block: its page, relative to the checkout
    command: str  # for readers
    sources: Tuple[str, ...]  # git pathspecs of the code that is measured
    measure: Optional[Measure] = None  # gives contents by name; None: the command writes the block
    excerpt_of: Optional[str] = None  # the block whose rows it quotes


def _benchmark(name: str) -> Subject:
    sources = NODES if name == "loop" else CLOSED_LOOP
    command = f"scripts/benchmark {name} --update-docs"
    return Subject({f"benchmark_{name}": BENCHMARKS}, command, sources)


SUBJECT_LIST: Sequence[Subject] = (
    Subject(
        {"scenarios": README, "margins": RESULTS},
        "run_scenario NAME [--no-safety] [--set controller.formulation=paper]",
        CLOSED_LOOP,
        scenarios.measure_ropes,
    ),
    Subject(
        {"fabric_scenario": README, "fabric_margins": RESULTS},
        "run_scenario fabric_three_assistants [--no-safety] [--set controller.formulation=paper]",
        CLOSED_LOOP,
        scenarios.measure_fabrics,
    ),
    Subject(
        {"moving_obstacle": SAFETY},
        "run_scenario rope_moving_obstacle [OPTIONS]",
        CLOSED_LOOP,
        scenarios.measure_moving_obstacle,
    ),
    Subject(
        {"campaigns": SAFETY, "campaigns_summary": README},
        "run_campaign SCENARIO --runs N --seed 1 --duration 60 [--set VALUE]",
        CAMPAIGNS,
        campaigns.measure_campaigns,
    ),
    Subject(
        {"campaigns_stiff_rod": SAFETY},
        "run_campaign stiff_rod_one_assistant --runs 200 --seed 1 --duration 60",
        CAMPAIGNS,
        campaigns.measure_stiff_rods,
    ),
    Subject(
        {"campaigns_fabric": SAFETY},
        "run_campaign fabric_three_assistants --runs N --seed SEED --duration 60 [--set VALUE]",
        CAMPAIGNS,
        campaigns.measure_fabrics,
    ),
    Subject(
        {"campaigns_moving_obstacle": SAFETY},
        "run_campaign rope_moving_obstacle --runs 200 --seed 1 --duration 40 [--set VALUE]",
        CAMPAIGNS,
        campaigns.measure_moving_obstacles,
    ),
    Subject(
        {"seen_obstacles": SAFETY},
        "run_scenario NAME [OPTIONS]",
        CLOSED_LOOP,
        seen.measure_seen_obstacles,
    ),
    Subject(
        {"campaigns_seen": SAFETY},
        "run_campaign rope_over_depth_camera --runs 20 --seed 1 --duration 60",
        CAMPAIGNS,
        seen.measure_seen_campaign,
    ),
    Subject(
        {"fast_leaders": SAFETY},
        "run_campaign SCENARIO --runs N --seed 31 --duration 50 --speed M/S [OPTIONS]",
        CAMPAIGNS,
        fast_leaders.measure_fast_leaders,
    ),
    Subject(
        {"fast_leaders_beside": SAFETY},
        "run_campaign SCENARIO --runs N --seed 31 --duration 50 --speed M/S [OPTIONS]",
        CAMPAIGNS,
        fast_leaders.measure_fast_leaders_beside,
    ),
    Subject(
        {"announcements": SAFETY},
        "run_campaign rope_one_assistant --runs 40 --seed 11 --duration 50 --speed 0.3 [OPTIONS]",
        CAMPAIGNS,
        announcements.measure_announcements,
    ),
    Subject(
        {"wrong_announcements": SAFETY},
        "run_campaign rope_one_assistant --runs 40 --seed 11 --duration 50 --speed 0.3 [OPTIONS]",
        CAMPAIGNS,
        announcements.measure_wrong_announcements,
    ),
    Subject(
        {"terms": SAFETY},
        "run_campaign rope_one_assistant --runs 100 --seed 7 --duration 60 [OPTIONS]",
        CAMPAIGNS,
        campaigns.measure_terms,
    ),
    Subject(
        {"knowledge": SAFETY},
        "run_campaign rope_one_assistant --runs 6 --seed 1 --duration 60 --material 1 [OPTIONS]",
        CAMPAIGNS,
        campaigns.measure_knowledge,
    ),
    Subject(
        {"other_world": SAFETY},
        "run_scenario SCENARIO --world mujoco [OPTIONS]",
        CLOSED_LOOP,
        worlds.measure_ropes,
    ),
    Subject(
        {"other_world_fabric": SAFETY},
        "run_scenario fabric_three_assistants --world mujoco [OPTIONS]",
        CLOSED_LOOP,
        worlds.measure_fabrics,
    ),
    Subject({"clamp": REAL_OBJECTS}, "by hand, hang() of the validation", THEORY),
    Subject({"grips": REAL_OBJECTS}, "validate --case grips, and hang() without grips", THEORY),
    Subject({"world_theory": REAL_OBJECTS}, "by hand, see test_engine_world.py", CLOSED_LOOP),
    Subject({"fabric_gradients": SAFETY}, "by hand, see test_fabric_gradients.py", CLOSED_LOOP),
    Subject({"stiff_fabric": SAFETY}, "run_campaign fabric_three_assistants [OPTIONS]", CAMPAIGNS),
    Subject({"cooperation": SAFETY}, "run_scenario NAME [OPTIONS]", CLOSED_LOOP),
    Subject({"recovery": SAFETY}, "by hand, see test_recovery.py", CLOSED_LOOP),
    Subject(
        {"smoothing": SAFETY}, "run_scenario NAME --set controller.smoothing=VALUE", CLOSED_LOOP
    ),
    Subject(
        {"rope": RESULTS}, "run_scenario rope_one_assistant and roslaunch by hand", CLOSED_LOOP
    ),
    Subject({"realtime": RESULTS}, "scripts/benchmark loop, copied by hand", NODES),
    Subject({"validation": VALIDATION}, "scripts/validate", THEORY),
    Subject({"validation_excerpt": RESULTS}, "scripts/validate", THEORY, excerpt_of="validation"),
    *(_benchmark(name) for name in SUBJECTS),
)
SUBJECTS_BY_BLOCK: Dict[str, Subject] = {
    name: subject for subject in SUBJECT_LIST for name in subject.pages
}
PAGES: Tuple[str, ...] = tuple(
    dict.fromkeys(page for subject in SUBJECT_LIST for page in subject.pages.values())
)


def page_of(name: str) -> str:
    """Return the page of a block, relative to the checkout."""
    return SUBJECTS_BY_BLOCK[name].pages[name]
