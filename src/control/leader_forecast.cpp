#include "deformable_manipulation/control/leader_forecast.h"

#include <algorithm>
#include <cmath>

namespace deformable_manipulation {
namespace control {
namespace {

constexpr double RECORD_INTERVAL = 0.05;  // [s] between expectations that are compared with what becomes true
constexpr double LATEST_JUDGEMENT = 0.2;  // [s] after the time of a node; the leader was not seen for longer
constexpr double MEMORY = 2.0;            // [s] in which something is claimed, after which evidence counts less
constexpr double CLAIM = 0.005;           // [m] from which on something is claimed
constexpr double LEAST_CLAIM = CLAIM * CLAIM * 1.0;  // [m^2 s] before which there is no trust
constexpr double REMAINDER = 0.25;                   // of the doubt, where the announcement is trusted

}  // namespace

void LeaderForecast::setParameters(const HorizonParameters& parameters) {
  const bool other_nodes = parameters.nodes != parameters_.nodes || parameters.length != parameters_.length;
  parameters_ = parameters;
  interval_ = parameters.length / parameters.nodes;
  if (other_nodes) {
    reset();
  }
}

void LeaderForecast::reset() {
  const auto nodes = static_cast<std::size_t>(parameters_.nodes);
  evidence_.assign(nodes, Evidence());
  trust_.assign(nodes, 0.0);
  ways_.assign(nodes, 0.0);
  fading_.assign(nodes, Vector3::Zero());
  announced_ = fading_;
  positions_.assign(nodes + 1, Vector3::Zero());
  records_.clear();
  dropped_ = 0;
  recent_ = 0.0;
  seen_.reset();
}

void LeaderForecast::look(const ObservationView& observation, const PredictedState& predicted) {
  const double start = observation.time + predicted.delay;
  remember(observation.time, predicted.leaderVelocity().norm());
  fade(predicted.leaderVelocity());
  judge(observation.time, observation.position(predicted.leader), predicted.leaderVelocity());
  const bool announced = parameters_.leader != ExpectedLeader::FADING && read(observation.announcement, start);
  findTrust(announced);
  if (announced) {
    keep(start, predicted.positions[predicted.leader]);
  }
  positions_[0] = predicted.positions[predicted.leader];
  for (int node = 0; node < parameters_.nodes; ++node) {
    positions_[node + 1] = positions_[0] + fading_[node];
    if (trust_[node] > 0.0) {
      positions_[node + 1] += trust_[node] * (announced_[node] - fading_[node]);
    }
  }
}

//! A leader that was fast lately may be so again.
void LeaderForecast::remember(double time, double speed) {
  const double kept = seen_ ? std::exp(-std::max(0.0, time - *seen_) / parameters_.leader_memory) : 0.0;
  speed_ = speed;
  recent_ = std::max(speed, kept * recent_);
  seen_ = time;
}

//! Displacements by a velocity that fades.
void LeaderForecast::fade(const Vector3& velocity) {
  for (int node = 0; node < parameters_.nodes; ++node) {
    const double fade = parameters_.leader_fade;
    fading_[node] = fade * (1.0 - std::exp(-timeOf(node) / fade)) * velocity;
  }
}

//! Displacements as announced, which the fading velocity continues; false where nothing usable is announced for now.
bool LeaderForecast::read(const AnnouncementView& announcement, double start) {
  if (!findFault(announcement).empty() || start < announcement.begin() || start > announcement.end()) {
    return false;
  }
  const Vector3 origin = announcement.position(start);
  for (int node = 0; node < parameters_.nodes; ++node) {
    const Vector3 before = node > 0 ? announced_[node - 1] : Vector3::Zero();
    if (start + timeOf(node) <= announcement.end()) {
      announced_[node] = announcement.position(start + timeOf(node)) - origin;
    } else {
      announced_[node] = before + fading_[node] - (node > 0 ? fading_[node - 1] : Vector3::Zero());
    }
    ways_[node] = (node > 0 ? ways_[node - 1] : 0.0) + (announced_[node] - before).norm();
  }
  return true;
}

//! Compares what was expected for the present with what is measured.
void LeaderForecast::judge(double time, const Vector3& position, const Vector3& velocity) {
  const long end = dropped_ + static_cast<long>(records_.size());
  for (int node = 0; node < parameters_.nodes; ++node) {
    Evidence& evidence = evidence_[node];
    for (; evidence.next < end; ++evidence.next) {
      const Record& record = records_[evidence.next - dropped_];
      const double late = time - record.time - timeOf(node);
      if (late < 0.0) {
        break;
      }
      if (late < LATEST_JUDGEMENT) {
        learn(record, node, position - late * velocity - record.position);
      }
    }
  }
  dropJudged();
}

//! Sums for the least squares, which fade as more is claimed.
void LeaderForecast::learn(const Record& record, int node, const Vector3& moved) {
  const Vector3 claim = record.announced[node] - record.fading[node];
  const double size = claim.squaredNorm();
  const double kept = std::exp(-RECORD_INTERVAL / MEMORY * size / (size + CLAIM * CLAIM));
  Evidence& evidence = evidence_[node];
  evidence.agreement = kept * evidence.agreement + RECORD_INTERVAL * claim.dot(moved - record.fading[node]);
  evidence.claim = kept * evidence.claim + RECORD_INTERVAL * size;
}

void LeaderForecast::dropJudged() {
  while (!records_.empty() && evidence_.back().next > dropped_) {  // the last node is the last to be judged
    records_.pop_front();
    ++dropped_;
  }
}

//! What a node has no evidence of yet is trusted as the node before it is; what has misled at a shorter time ahead
//! is not trusted at a longer one.
void LeaderForecast::findTrust(bool announced) {
  double earned = 0.0;
  double most = 1.0;
  for (int node = 0; node < parameters_.nodes; ++node) {
    const Evidence& evidence = evidence_[node];
    earned = (evidence.agreement + LEAST_CLAIM * earned) / (evidence.claim + LEAST_CLAIM);
    earned = std::clamp(earned, 0.0, most);
    most = std::clamp((evidence.agreement + LEAST_CLAIM) / (evidence.claim + LEAST_CLAIM), 0.0, most);
    const bool known = parameters_.leader == ExpectedLeader::KNOWN;
    trust_[node] = !announced ? 0.0 : known ? 1.0 : earned;
  }
}

//! Keeps what is expected now, to be judged by what becomes true.
void LeaderForecast::keep(double start, const Vector3& position) {
  if (records_.empty() || start - records_.back().time > RECORD_INTERVAL - 1e-9) {
    records_.push_back({start, position, fading_, announced_});
  }
}

double LeaderForecast::doubt(int node) const {
  const double trusted = trust_[node] > 0.0 ? trust_[node] * REMAINDER * ways_[node] / timeOf(node) : 0.0;
  return parameters_.leader_doubt * ((1.0 - trust_[node]) * recent_ + trusted);
}

double LeaderForecast::fastest() const {
  double fastest = std::max(speed_, (1.0 - trust_.back()) * recent_);
  for (int node = 0; node < parameters_.nodes; ++node) {
    fastest = std::max(fastest, (positions_[node + 1] - positions_[node]).norm() / interval_);
  }
  return fastest;
}

}  // namespace control
}  // namespace deformable_manipulation
