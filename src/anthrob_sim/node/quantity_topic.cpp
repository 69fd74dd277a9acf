#include "quantity_topic.h"

#include <anthrob_msgs/Quantities.h>

#include <algorithm>

#include "anthrob_ros/bounded_connection.h"

namespace anthrob {

QuantityTopic::QuantityTopic(ros::NodeHandle& nh, Simulation& sim,
                             const std::vector<std::string>& paths)
    : sim_(sim), all_(quantities_of(sim.model())) {
  choose(paths);
  publisher_ = nh.advertise<anthrob_msgs::Quantities>("sim/quantities", 100);
  service_ = advertise_bounded<anthrob_msgs::ChooseQuantities>(
      nh, "sim/choose_quantities",
      [this](auto& request, auto& response) { return on_choose(request, response); });
}

void QuantityTopic::choose(const std::vector<std::string>& paths) {
  chosen_ = select_quantities(all_, paths);
  if (std::any_of(chosen_.begin(), chosen_.end(),
                  [](const Quantity& quantity) { return quantity.of_reactions; })) {
    sim_.observe_reactions();
  }
}

bool QuantityTopic::on_choose(anthrob_msgs::ChooseQuantities::Request& request,
                              anthrob_msgs::ChooseQuantities::Response& response) {
  try {
    if (!request.name.empty()) choose(request.name);
    response.success = true;
    response.message = std::to_string(chosen_.size()) + " of " + std::to_string(all_.size()) +
                       " quantities are on sim/quantities";
  } catch (const BadInput& error) {
    response.message = error.what();
  }
  for (const Quantity& quantity : chosen_) response.chosen.push_back(quantity.path);
  for (const Quantity& quantity : all_) response.available.push_back(quantity.path);
  return true;
}

void QuantityTopic::publish(const ros::Time& stamp) const {
  if (chosen_.empty() || publisher_.getNumSubscribers() == 0) return;
  anthrob_msgs::Quantities message;
  message.header.stamp = stamp;
  message.header.frame_id = sim_.model().skeleton->bodies[0].name;
  for (const Quantity& quantity : chosen_) {
    message.name.push_back(quantity.path);
    message.value.push_back(quantity.read(sim_));
  }
  publisher_.publish(message);
}

}  // namespace anthrob
