#include "object_services.h"

#include <algorithm>
#include <stdexcept>

#include "agent_directory.h"

namespace deformable_manipulation {
namespace {

//! Runs an action that returns what it did; its exceptions are the reason why nothing changed.
template <typename Response, typename Action>
bool answer(Response& response, Action action) {
  try {
    response.message = action();
    response.success = true;
  } catch (const std::logic_error& error) {
    response.message = std::string("Nothing changed: ") + error.what() + ".";
    response.success = false;
  }
  return true;
}

pbd::Hold toHold(const std::string& name, pbd::Hold otherwise) {
  if (name.empty()) {
    return otherwise;
  }
  if (name != "clamped" && name != "pinned") {
    throw std::invalid_argument("hold is '" + name + "'; it must be clamped, pinned, or empty");
  }
  return name == "clamped" ? pbd::Hold::CLAMPED : pbd::Hold::PINNED;
}

}  // namespace

ObjectServices::ObjectServices(ros::NodeHandle& node, pbd::Simulation& simulation) : simulation_(simulation) {
  servers_ = {node.advertiseService("set_perturbations", &ObjectServices::setPerturbations, this),
              node.advertiseService("clear_perturbations", &ObjectServices::clearPerturbations, this),
              node.advertiseService("hold", &ObjectServices::hold, this),
              node.advertiseService("release", &ObjectServices::release, this),
              node.advertiseService("set_material", &ObjectServices::setMaterial, this)};
}

std::string ObjectServices::copiesNow() const {
  return "There are " + std::to_string(simulation_.body().copies().size()) + " perturbed copies.";
}

bool ObjectServices::setPerturbations(SetPerturbations::Request& request, SetPerturbations::Response& response) {
  return answer(response, [&] {
    if (request.agents.size() != request.displacements.size()) {
      throw std::invalid_argument("agents and displacements must have the same length");
    }
    std::vector<int> present;
    for (const pbd::PerturbedCopy& copy : simulation_.body().copies()) {
      present.push_back(copy.id);
    }
    std::vector<int> added;
    try {
      for (std::size_t i = 0; i < request.agents.size(); ++i) {
        const geometry_msgs::Vector3& d = request.displacements[i];
        const int agent = agentNamed(simulation_, request.agents[i]);
        added.push_back(simulation_.addPerturbation({agent, pbd::Vector3(d.x, d.y, d.z)}));
      }
    } catch (const std::logic_error&) {
      simulation_.removePerturbations(added);
      throw;
    }
    if (request.replace) {
      simulation_.removePerturbations(present);
    }
    return copiesNow();
  });
}

bool ObjectServices::clearPerturbations(ClearPerturbations::Request& request, ClearPerturbations::Response& response) {
  return answer(response, [&] {
    std::vector<int> agents;
    for (const std::string& name : request.agents) {
      agents.push_back(agentNamed(simulation_, name));
    }
    for (std::size_t i = 0; request.agents.empty() && i < simulation_.agents().size(); ++i) {
      agents.push_back(static_cast<int>(i));
    }
    std::for_each(agents.begin(), agents.end(), [&](int agent) { simulation_.clearPerturbations(agent); });
    return copiesNow();
  });
}

bool ObjectServices::hold(HoldParticle::Request& request, HoldParticle::Response& response) {
  return answer(response, [&] {
    const int index = agentNamed(simulation_, request.agent);
    const pbd::Agent& agent = simulation_.agents()[index];
    const bool as_given = request.particle == -1;
    if (as_given && !request.further_particles.empty()) {
      throw std::invalid_argument("further_particles are those of the scenario with particle -1; leave them empty");
    }
    const int particle = as_given ? agent.particle : request.particle;
    const std::vector<int> further = as_given ? agent.further : request.further_particles;
    const pbd::Hold type = toHold(request.hold, agent.hold);
    if (type == pbd::Hold::PINNED && !further.empty()) {
      throw std::invalid_argument("hold must be clamped for several particles");
    }
    simulation_.hold(index, particle, type, further);
    const std::string others = further.empty() ? "" : " and " + std::to_string(further.size()) + " more";
    return agent.name + " holds particle " + std::to_string(particle) + others + ".";
  });
}

bool ObjectServices::release(ReleaseParticle::Request& request, ReleaseParticle::Response& response) {
  return answer(response, [&] {
    simulation_.release(agentNamed(simulation_, request.agent));
    return request.agent + " holds nothing.";
  });
}

bool ObjectServices::setMaterial(SetMaterial::Request& request, SetMaterial::Response& response) {
  return answer(response, [&] {
    if (request.keys.size() != request.values.size() || request.keys.empty()) {
      throw std::invalid_argument("keys and values must have the same length, not zero");
    }
    std::vector<pbd::MaterialParameter> parameters;
    for (std::size_t i = 0; i < request.keys.size(); ++i) {
      parameters.push_back({request.keys[i], request.values[i]});
    }
    simulation_.setMaterial(parameters);
    return std::string("The material has been changed.");
  });
}

}  // namespace deformable_manipulation
