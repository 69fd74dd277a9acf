// Numbers of a running robot and of recordings over time, without RViz.
#include <ros/ros.h>

#include <QApplication>
#include <QFile>
#include <QTimer>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "anthrob_core/command_line.h"
#include "anthrob_core/errors.h"
#include "anthrob_ros/master_uri.h"
#include "plot/scope_widget.h"
#include "ros/scope/scope_over_ros.h"

namespace anthrob {
namespace {

struct ScopeOptions {
  std::vector<std::string> recordings, plotted, exported;
  std::string layout;
  bool difference = false;
};

std::string text_of_file(const std::string& name) {
  QFile file(QString::fromStdString(name));
  if (!file.open(QIODevice::ReadOnly))
    throw BadInput(name + ": " + file.errorString().toStdString());
  return file.readAll().toStdString();
}

/// All quantities whose path contains the text.
void tick_all(const std::string& text, ScopeWidget& scope) {
  std::set<std::string> paths;
  for (const auto& [path, quantity] : scope.model().quantities()) {
    if (path.find(text) != std::string::npos) paths.insert(path);
  }
  if (paths.empty())
    throw BadInput("--plot " + text + ": no quantity of the recordings has this in its name");
  scope.tick(paths);
}

/// Qt would abort.
void require_screen() {
  for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"}) {
    if (qEnvironmentVariableIsSet(name)) return;
  }
  throw BadInput("no screen: DISPLAY is not set; --export FILE needs none");
}

int show_scope(const ScopeOptions& options, std::unique_ptr<ScopeModel> model) {
  ScopeWidget scope(std::move(model));
  scope.setWindowTitle("anthrob_scope");
  scope.resize(1200, 750);
  if (!options.exported.empty()) scope.setAttribute(Qt::WA_DontShowOnScreen);
  if (!options.layout.empty()) {
    const auto wrong = scope.restore_layout(QString::fromStdString(text_of_file(options.layout)));
    if (wrong) throw BadInput(options.layout + ": " + *wrong);
    for (const std::string& recording : options.recordings) scope.model().open(recording);
  }
  for (const std::string& text : options.plotted) tick_all(text, scope);
  if (options.difference) scope.set_differences(true);
  scope.show();
  for (const std::string& file : options.exported) {
    QApplication::processEvents();
    if (const auto wrong = scope.export_to(file)) throw std::runtime_error(*wrong);
    std::cout << "wrote " << file << std::endl;
  }
  if (!options.exported.empty()) return tool::kDone;
  QTimer interrupts;
  QObject::connect(&interrupts, &QTimer::timeout, [] {
    if (tool::interrupted()) QApplication::quit();
  });
  interrupts.start(100);
  return QApplication::exec();
}

}  // namespace
}  // namespace anthrob

int main(int argc, char** argv) {
  using namespace anthrob;
  CLI::App app(
      "Plots any number of any topic over time: of a running robot, of recordings, or of both.",
      "anthrob_scope");
  ScopeOptions options;
  app.add_option("RECORDING", options.recordings,
                 "bags or data set folders; several are laid upon each other");
  app.add_option("--plot", options.plotted,
                 "ticks all quantities of the recordings whose name contains this")
      ->allow_extra_args(false);
  app.add_flag("--difference", options.difference,
               "plots the second recording minus the first one, with rms");
  app.add_option("--layout", options.layout, "file of a saved layout");
  app.add_option("--export", options.exported,
                 "writes what is plotted to FILE.csv, .svg, .pdf or .png, and ends")
      ->allow_extra_args(false);
  return tool::run(app, argc, argv, [&]() -> int {
    if (const auto wrong = wrong_master_uri({argv + 1, argv + argc})) throw BadInput(*wrong);
    // Pictures need no screen.
    if (!options.exported.empty()) qputenv("QT_QPA_PLATFORM", "offscreen");
    ros::init(argc, argv, "anthrob_scope",
              ros::init_options::AnonymousName | ros::init_options::NoSigintHandler);
    auto model = scope_over_ros();
    // A layout has recordings of its own, before these.
    if (options.layout.empty()) {
      for (const std::string& recording : options.recordings) model->open(recording);
    }
    require_screen();
    int qt_argc = 1;
    QApplication application(qt_argc, argv);
    return show_scope(options, std::move(model));
  });
}
