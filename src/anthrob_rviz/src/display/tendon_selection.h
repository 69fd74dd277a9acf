#pragma once

#include <rviz/selection/selection_handler.h>

#include <optional>
#include <string>

namespace rviz {
class BoolProperty;
class StringProperty;
}  // namespace rviz

namespace anthrob {

/// What a selected tendon tells.
struct TendonFacts {
  std::string name;
  std::optional<double> force;  ///< [N]; none: not measured
  bool slack = false;
  double length = 0.0;  ///< [m]
  bool old = false;     ///< force and slack are not those of now
};

/// Makes a tendon selectable; the panel Selection shows its facts.
class TendonSelection : public rviz::SelectionHandler {
 public:
  /// @param facts must outlive it
  TendonSelection(rviz::DisplayContext* context, const TendonFacts& facts);
  void createProperties(const rviz::Picked& picked, rviz::Property* parent) override;
  void destroyProperties(const rviz::Picked& picked, rviz::Property* parent) override;
  void updateProperties() override;

 private:
  const TendonFacts& facts_;
  rviz::StringProperty *force_ = nullptr, *slack_ = nullptr, *length_ = nullptr;
};

/// The facts as the panel shows them: "12.3 N", "not measured", "yes", "231.5 mm".
std::string force_text(const TendonFacts& facts);
std::string slack_text(const TendonFacts& facts);
std::string length_text(const TendonFacts& facts);

}  // namespace anthrob
