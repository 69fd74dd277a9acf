#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "anthrob_reference/arm.h"
#include "readings.h"

namespace anthrob::virtual_robot {

/// Description of a robot to build: parameters of the reference arm, and additional laws. Laws have
/// state, so a draft can be used for one robot only.
struct Draft {
  reference::ArmParameters arm;
  std::uint64_t run = 0;  ///< number of the run: random events differ between runs
  std::vector<std::pair<std::size_t, std::shared_ptr<reference::MuscleLaw>>> muscle_laws;
  std::vector<std::shared_ptr<reference::JointLaw>> joint_laws;
  std::vector<std::shared_ptr<CommandLaw>> command_laws;
  std::vector<std::shared_ptr<PowerLaw>> power_laws;
  std::vector<std::shared_ptr<ReadingLaw>> reading_laws;

  /// @throws std::invalid_argument
  std::size_t muscle(const std::string& name) const;
  /// Indices of the muscles at a place: one, or all of them for "all".
  std::vector<std::size_t> muscles(const std::string& place) const;
};

/// Parts of a place: "biceps_brachii/2/x" -> three words.
std::vector<std::string> words(const std::string& place);

}  // namespace anthrob::virtual_robot
