#include "simulator_diagnostics.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace deformable_manipulation {
namespace {

using diagnostic_msgs::DiagnosticStatus;

constexpr double kReportPeriod = 1.0;  // s
constexpr double kSilent = 1.0;        // s, without measured points, before it is said

}  // namespace

SimulatorDiagnostics::SimulatorDiagnostics(ros::NodeHandle& node, const pbd::Simulation& simulation,
                                           const std::vector<AgentLink>& links, const RunControl& control,
                                           bool lockstep)
    : simulation_(simulation), links_(links), control_(control), lockstep_(lockstep) {
  updater_.setHardwareID("none");
  updater_.add("loop", this, &SimulatorDiagnostics::reportLoop);
  updater_.add("object", this, &SimulatorDiagnostics::reportObject);
  updater_.add("agents", this, &SimulatorDiagnostics::reportAgents);
  timer_ = node.createSteadyTimer(ros::WallDuration(kReportPeriod), &SimulatorDiagnostics::report, this);
}

void SimulatorDiagnostics::watchCorrection() {
  updater_.add("correction", this, &SimulatorDiagnostics::reportCorrection);
}

void SimulatorDiagnostics::countCycle(double busy) {
  ++now_.cycles;
  now_.busy += busy;
  now_.busiest = std::max(now_.busiest, busy);
}

void SimulatorDiagnostics::countOverrun() {
  ++now_.overruns;
  ++overruns_;
}

void SimulatorDiagnostics::countResponse(pbd::ResponseStatus status) {
  ++now_.responses;
  if (status != pbd::ResponseStatus::VALID) {
    ++now_.unknown_responses;
    now_.why_unknown = status;
  }
}

void SimulatorDiagnostics::report(const ros::SteadyTimerEvent&) {
  last_ = now_;
  now_ = Second();
  updater_.force_update();
}

void SimulatorDiagnostics::reportLoop(Status& status) {
  const double elapsed = (now_.begun - last_.begun).toSec();
  const double cycle_time = simulation_.clock().cycleTime();
  status.addf("cycles per second", "%.1f", last_.cycles / elapsed);
  status.addf("overruns, total", "%ld", overruns_);
  if (last_.cycles > 0) {
    status.addf("work per cycle [ms], mean", "%.3f", 1e3 * last_.busy / last_.cycles);
    status.addf("work per cycle [ms], largest", "%.3f", 1e3 * last_.busiest);
  }
  if (last_.cycles == 0 && control_.halted()) {
    status.summary(DiagnosticStatus::OK, "Paused.");
  } else if (last_.cycles == 0) {
    status.summary(DiagnosticStatus::STALE, "Stands still: waiting for other nodes (see the log).");
  } else if (last_.overruns > 0) {
    const bool most = 2 * last_.overruns > last_.cycles;
    status.summaryf(most ? DiagnosticStatus::ERROR : DiagnosticStatus::WARN,
                    "%ld of %ld cycles took longer than %.1f ms: the simulation lags behind.", last_.overruns,
                    last_.cycles, 1e3 * cycle_time);
  } else {
    status.summaryf(DiagnosticStatus::OK, "%s, %.1f times as fast as real time.", lockstep_ ? "Lock-step" : "In time",
                    last_.cycles * cycle_time / elapsed);
  }
}

void SimulatorDiagnostics::reportObject(Status& status) {
  const double stretch = simulation_.body().stretch();
  status.addf("relative error of its length", "%.2e", stretch);
  status.add("rest at the start", pbd::name(simulation_.rest()));
  status.add("perturbed copies", simulation_.body().copies().size());
  status.addf("exact responses found", "%ld of %ld", last_.responses - last_.unknown_responses, last_.responses);
  if (std::abs(stretch) > simulation_.body().largestStretch()) {
    status.summaryf(DiagnosticStatus::WARN,
                    "Its length is wrong by %.1f %%: it is pulled apart, or needs more simulation.substeps.",
                    100.0 * stretch);
  } else if (last_.unknown_responses > 0) {
    status.summaryf(DiagnosticStatus::WARN,
                    "The exact response was not known in %ld of %ld cycles, and perturbed copies took over: %s.",
                    last_.unknown_responses, last_.responses, pbd::describe(last_.why_unknown));
  } else if (simulation_.rest() != pbd::Rest::STABLE) {
    status.summary(DiagnosticStatus::WARN, pbd::describe(simulation_.rest()));
  } else {
    status.summary(DiagnosticStatus::OK, "Solved within its tolerance.");
  }
}

void SimulatorDiagnostics::reportCorrection(Status& status) {
  const pbd::ShapeCorrection& correction = *simulation_.correction();
  status.addf("largest correction [mm]", "%.1f", 1e3 * correction.largest());
  status.addf("age of the measured points [s]", "%.2f", correction.age());
  if (correction.disagrees()) {
    status.summary(DiagnosticStatus::ERROR, correction.stops()
                                                ? "The model disagrees with the measured points: the assistants stop."
                                                : "The model disagrees with the measured points.");
  } else if (!(correction.age() < kSilent)) {
    status.summary(DiagnosticStatus::WARN, "There are no measured points: the correction fades.");
  } else {
    status.summary(DiagnosticStatus::OK, "Measured points correct the model.");
  }
}

void SimulatorDiagnostics::reportAgents(Status& status) {
  std::string faults;
  for (const AgentLink& link : links_) {
    const std::string fault = link.fault();
    status.add(link.name(), fault.empty() ? "in time" : fault);
    if (!fault.empty()) {
      faults += (faults.empty() ? "" : "; ") + link.name() + ": " + fault;
    }
  }
  const bool all_well = faults.empty();
  status.summary(all_well ? DiagnosticStatus::OK : DiagnosticStatus::STALE,
                 all_well ? "All agents get their inputs in time." : faults + ".");
}

}  // namespace deformable_manipulation
