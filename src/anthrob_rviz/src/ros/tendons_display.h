#pragma once

#include <anthrob_msgs/TendonPaths.h>
#include <ros/ros.h>
#include <rviz/display.h>

#include <memory>
#include <optional>
#include <vector>

#include "display/screen_overlay.h"
#include "display/tendon_visual.h"
#include "display/theme.h"
#include "tendon.h"
#include "tendon_status.h"

namespace rviz {
class EnumProperty;
class FloatProperty;
class RosTopicProperty;
class StringProperty;
}  // namespace rviz

namespace anthrob {

/// Tendons as tubes, coloured by force. Each point of a tendon is put, at every frame, where RViz
/// puts the link that carries it at this frame: a tendon never leaves its bones, whatever the rates
/// of frames, messages and tf.
class TendonsDisplay : public rviz::Display {
 public:
  TendonsDisplay();
  ~TendonsDisplay() override;

  void update(float wall_dt, float ros_dt) override;
  void reset() override;
  void setTopic(const QString& topic, const QString& datatype) override;

  const std::vector<std::unique_ptr<TendonVisual>>& visuals() const { return visuals_; }

 protected:
  void onInitialize() override;
  void onEnable() override;
  void onDisable() override;
  void fixedFrameChanged() override { reset(); }

 private:
  void subscribe();
  void hear(const anthrob_msgs::TendonPaths& message);
  bool are_other_tendons() const;
  void take_visuals();
  TendonFeed feed() const;
  std::optional<Pose> pose_of(const std::string& link) const;
  void draw(const PlacedTendons& placed, bool old);
  double thickness(const PlacedTendons& placed);
  void fit_view(const PlacedTendons& placed);
  Theme theme() const;
  void take_theme();
  void show_legend();
  void show_status(const char* name, const StatusLine& line);

  rviz::RosTopicProperty* topic_;
  rviz::FloatProperty *thickness_, *full_force_;
  rviz::EnumProperty* theme_;
  rviz::BoolProperty *names_, *legend_shown_, *fit_view_;
  rviz::StringProperty* tf_prefix_;

  ros::Subscriber subscriber_;
  std::vector<Tendon> tendons_;
  std::optional<double> heard_;       ///< [s] when the last message came
  std::optional<std::string> wrong_;  ///< what was, with it
  std::vector<std::unique_ptr<TendonVisual>> visuals_;
  std::optional<double> fitting_;  ///< [m] thickness for this robot
  std::optional<double> whole_;    ///< [s] since when all of the robot is there
  bool view_fitted_ = false;
  std::unique_ptr<ScreenOverlay> legend_;
  std::optional<double> legend_force_;  ///< [N] of the legend that is shown
};

}  // namespace anthrob
