#pragma once

#include <rviz/panel.h>

#include <QLabel>
#include <QLineEdit>
#include <QTimer>
#include <QVBoxLayout>
#include <memory>
#include <optional>
#include <string>

#include "robot_connection.h"
#include "robot_summary.h"

namespace anthrob {

/// A panel of one robot, whose namespace is the property "Robot" in the .rviz file. It looks for
/// news fifty times a second, and shows them ten times a second.
class ConnectedPanel : public rviz::Panel {
 public:
  void load(const rviz::Config& config) override;
  void save(rviz::Config config) const override;

 protected:
  /// @param robot namespace until load() or its user names another one
  ConnectedPanel(std::unique_ptr<RobotConnection> connection, const std::string& robot);

  /// Before another robot is connected.
  virtual void end() {}
  /// Another robot is connected from now on.
  virtual void begin() = 0;
  virtual void hear(const News& news, double now) = 0;
  /// To be done often.
  virtual void act(double now) = 0;
  virtual void refresh(double now) = 0;

  RobotConnection& connection() { return *connection_; }
  /// From the root.
  const std::string& robot() const { return robot_; }
  Presence presence(double now) const;
  std::string state_text(double now) const;
  QVBoxLayout* column() { return column_; }

 private:
  void tick();
  void choose(const QString& text);
  void connect_robot();

  std::unique_ptr<RobotConnection> connection_;
  std::string robot_;
  bool connected_ = false;
  std::optional<double> heard_;  ///< [s] when there were muscles
  RobotSummary summary_;
  double next_refresh_ = 0.0;
  QVBoxLayout* column_;
  QLineEdit* edit_;
  QTimer timer_;
};

/// Of the colours that mean something in both panels.
QString colour_of(Level level);
/// A label whose text breaks and can be copied.
QLabel* text_label(const char* name);
/// Text in a colour of its own.
void show_text(QLabel* label, const std::string& text, const QString& colour);

}  // namespace anthrob
