#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace anthrob {
namespace jobs {

/// What a calibration is asked for: the options of anthrob_calibrate. Empty or 0: not given.
struct CalibrateOrder {
  std::string pipeline;  ///< file of stages, instead of one configuration, its data and options
  std::string config, data, validation, model, out;
  std::int64_t jobs = 0, seed = 0;
  std::vector<std::string> options;  ///< the other ones, word by word
};

/// The same of anthrob_discover.
struct DiscoverOrder {
  std::string model, calibration, out;
  std::vector<std::string> train, test, repeat;
  std::int64_t jobs = 0, seed = 0;
  std::vector<std::string> options;
};

/// A test of a robot's tendons: the node anthrob_health_test.
struct HealthOrder {
  std::string model, out;
  std::string robot;  ///< namespace
};

/// A program with its arguments, which writes into a folder.
struct JobCommand {
  std::string package, program;
  std::vector<std::string> arguments;
  std::string out;
  bool commands_robot = false;  ///< and so gives way to nobody
};

/// Continues what lies in `out`, if a calibration was interrupted there.
/// @throws BadInput with one line: a field that is missing, a path that is not whole (a node has a
/// working folder that nobody chose), an option that a field has already
JobCommand command_of(const CalibrateOrder& order);
JobCommand command_of(const DiscoverOrder& order);
JobCommand command_of(const HealthOrder& order);

}  // namespace jobs
}  // namespace anthrob
