#pragma once

#include <optional>
#include <vector>

#include "anthrob_calib/discovery/screening.h"
#include "anthrob_calib/discovery/workbench.h"

namespace anthrob {
namespace discovery {

/// Laws at one place may be one of more sizes: friction that differs by direction is friction and a
/// constant torque, too. And one law at several places may be everywhere, of one size.
class CommonLaw {
 public:
  /// An effect in a fit: its index in there, and which candidate it is.
  struct Part {
    std::size_t effect, candidate;
  };

  CommonLaw(const Workbench& bench, Screening& screening) : bench_(bench), screening_(screening) {}

  /// Whether a candidate may say alone what two others say.
  bool may_be(std::size_t law, std::size_t one, std::size_t other) const;
  /// The same law everywhere that some parts may be; nothing if there is none.
  std::optional<std::size_t> everywhere(const std::vector<Part>& parts) const;
  /// A law in place of others: the fit with it, its odds against them, and what it gains of the
  /// cost where none of them is.
  struct Instead {
    Tested tested;
    Naming::Odds odds;
    double gained;
    Eigen::VectorXf without;  ///< residual held out where none of them is

    bool is_better() const;
    /// So much that it is to be named in their stead.
    bool is_clearly_better() const;
  };
  /// That candidate, fitted to the end instead of some effects; it is the fit's last effect.
  /// @param with all of them, fitted to the end   @param parts what goes, in the fit's order
  /// @return nothing if it is out of reach of them
  std::optional<Instead> instead(std::size_t law, const Tested& with,
                                 const std::vector<Part>& parts) const;

 private:
  const Workbench& bench_;
  Screening& screening_;
};

}  // namespace discovery
}  // namespace anthrob
