"""Run a scenario several times, with random paths, obstacles and materials."""

from deformable_manipulation.campaign.report import describe, summarise, worst
from deformable_manipulation.campaign.runs import Campaign
from deformable_manipulation.campaign.variation import Ranges
from deformable_manipulation.scenario import load_scenario

RUNS = 4
TOLERANCE = 0.001  # m, up to which a violation does not count

campaign = Campaign(
    scenario=load_scenario("rope_one_assistant"),
    ranges=Ranges(speed=0.1, duration=45.0),
    seed=1,
)
outcomes = []
for index in range(RUNS):  # run_campaign does the same on all cores
    outcome = campaign.run(index)
    outcomes.append(outcome)
    print(
        f"run {index}: lowest distance {1e3 * outcome.min_distance:5.1f} mm, "
        f"constrained for {100.0 * outcome.constrained:.0f} % of the time"
    )

print(describe(summarise(outcomes, TOLERANCE)))
print(f"the run with the worst violation or the lowest distance is number {worst(outcomes).index}")
