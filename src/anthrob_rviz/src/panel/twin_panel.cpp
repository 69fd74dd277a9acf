#include "panel/twin_panel.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <cmath>
#include <utility>

#include "anthrob_core/text.h"

namespace anthrob {
namespace {

constexpr std::size_t kWindow = 1;   // of 10 s, in which the twin warns
constexpr double kSilent = 5.0;      // [s] of wall time; a gap comes once a second
const char* const kTwin = ": twin";  // ends the name of its status
const char* const kJobs[] = {"calibrate", "discover", "health/test"};

QTableWidgetItem* cell_of(double floors) {
  const bool told = std::isfinite(floors);
  auto* item =
      new QTableWidgetItem(told ? QString::number(floors, 'f', floors < 10.0 ? 1 : 0) : QString());
  item->setTextAlignment(Qt::AlignCenter);
  item->setFlags(Qt::ItemIsEnabled);
  QColor colour(colour_of(level_of_gap(floors)));
  colour.setAlpha(told ? 110 : 30);
  item->setBackground(colour);
  return item;
}

}  // namespace

TwinPanel::TwinPanel(std::unique_ptr<RobotConnection> connection, const std::string& robot)
    : ConnectedPanel(std::move(connection), robot),
      state_(text_label("state")),
      twin_(text_label("twin")),
      table_(new QTableWidget),
      health_(text_label("health")) {
  column()->addWidget(state_);
  column()->addWidget(twin_);
  table_->setObjectName("gaps");
  table_->setToolTip(
      "Gap of the last 10 s in floors: 1 is a right model with noise. Columns: what the copy of "
      "the model is fed with");
  table_->horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
  // Four columns in a narrow panel.
  table_->horizontalHeader()->setStyleSheet(
      "QHeaderView::section { font-size: 9px; padding: 1px; }");
  table_->verticalHeader()->setStyleSheet(
      "QHeaderView::section { font-size: 10px; padding: 1px; }");
  table_->verticalHeader()->setDefaultSectionSize(22);
  column()->addWidget(table_, 1);
  for (const char* job : kJobs) add_job(job);
  health_->setToolTip("What the tests of the tendons tell (docs/health.md)");
  column()->addWidget(health_);
}

void TwinPanel::add_job(const std::string& job) {
  JobLine line{text_label((job + "_text").c_str()), new QProgressBar, new QPushButton("Cancel")};
  line.bar->setObjectName(QString::fromStdString(job + "_bar"));
  line.bar->setMaximumHeight(14);
  line.cancel->setObjectName(QString::fromStdString(job + "_cancel"));
  line.cancel->setToolTip("Keeps what it has; the same goal goes on from there");
  connect(line.cancel, &QPushButton::clicked, this, [this, job] { connection().cancel(job); });
  auto* row = new QHBoxLayout;
  row->addWidget(new QLabel(QString::fromStdString(job)));
  row->addWidget(line.bar, 1);
  row->addWidget(line.cancel);
  column()->addLayout(row);
  column()->addWidget(line.text);
  line.bar->setRange(0, 100);
  line.cancel->setEnabled(false);
  jobs_[job] = line;
}

void TwinPanel::begin() {
  table_->clear();
  table_->setRowCount(0);
  warnings_.clear();
  health_->clear();
  heard_gap_.reset();
}

void TwinPanel::hear(const News& news, double now) {
  const std::string own = robot() + kTwin;
  for (const Diagnosis& diagnosis : news.diagnostics) {
    if (diagnosis.name.rfind(own, 0) == 0) warnings_[diagnosis.name] = diagnosis;
  }
  for (const JobReading& job : news.jobs) show_job(job);
  if (news.health) show_health(*news.health);
  if (!news.gap) return;
  heard_gap_ = now;
  show_gaps(*news.gap);
}

void TwinPanel::act(double) {}

void TwinPanel::refresh(double now) {
  const bool heard = presence(now) == Presence::kHeard;
  show_text(state_, state_text(now), colour_of(heard ? Level::kOk : Level::kWarning));
  const auto twin = warnings_.find(robot() + kTwin);
  if (twin == warnings_.end()) {
    show_text(twin_, "no twin: roslaunch anthrob_bringup calibrate.launch",
              colour_of(Level::kStale));
    return;
  }
  const bool silent = !heard_gap_ || now - *heard_gap_ > kSilent;
  std::vector<std::string> lines = {"twin: " + twin->second.message};
  Level worst = silent ? Level::kStale : twin->second.level;
  for (const auto& [name, diagnosis] : warnings_) {
    if (name == twin->first || diagnosis.level == Level::kOk) continue;
    lines.push_back(diagnosis.message);
    worst = Level::kError;
  }
  show_text(twin_, joined(lines, "\n"), colour_of(worst));
  table_->setEnabled(!silent);
}

void TwinPanel::show_gaps(const GapReading& reading) {
  const auto owners = gaps_by_owner(reading, kWindow);
  table_->setRowCount(static_cast<int>(owners.size()));
  table_->setColumnCount(static_cast<int>(reading.feeds.size()));
  QStringList feeds, names;
  for (const std::string& feed : reading.feeds) feeds << QString::fromStdString(feed);
  for (const OwnerGap& owner : owners) names << QString::fromStdString(owner.owner);
  table_->setHorizontalHeaderLabels(feeds);
  table_->setVerticalHeaderLabels(names);
  for (int row = 0; row < table_->rowCount(); ++row) {
    const OwnerGap& owner = owners[static_cast<std::size_t>(row)];
    for (int feed = 0; feed < table_->columnCount(); ++feed) {
      table_->setItem(row, feed, cell_of(owner.gaps[static_cast<std::size_t>(feed)]));
    }
  }
}

void TwinPanel::show_health(const HealthReading& reading) {
  std::vector<std::string> lines = reading.warnings;
  lines.insert(lines.begin(), reading.headline);
  show_text(health_, joined(lines, "\n"),
            colour_of(reading.warnings.empty() ? Level::kOk : Level::kWarning));
}

void TwinPanel::show_job(const JobReading& job) {
  const auto line = jobs_.find(job.job);
  if (line == jobs_.end()) return;
  line->second.cancel->setEnabled(job.runs);
  line->second.bar->setValue(static_cast<int>(std::lround(100.0 * (job.runs      ? job.share
                                                                   : job.success ? 1.0
                                                                                 : 0.0))));
  const Level level = job.runs ? Level::kWarning : job.success ? Level::kOk : Level::kError;
  show_text(line->second.text, text_of(job), colour_of(level));
}

}  // namespace anthrob
