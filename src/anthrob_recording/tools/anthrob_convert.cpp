// Recordings between bags and dataset folders.
#include <filesystem>
#include <iostream>

#include "anthrob_core/command_line.h"
#include "anthrob_core/errors.h"
#include "anthrob_core/files.h"
#include "anthrob_recording/bag.h"
#include "anthrob_recording/dataset.h"
#include "anthrob_recording/extent.h"
#include "foreign/foreign_csv.h"
#include "ros2/ros2_bag.h"

namespace {

void say_not_carried(const std::vector<std::string>& list) {
  for (const std::string& what : list) std::cout << "not converted: " << what << "\n";
}

void say_written(const std::string& out, const anthrob::Dataset& data) {
  std::cout << "wrote " << out << ": " << anthrob::extent_of(data) << "\n";
}

/// Refuses to write a dataset folder over the files that it is made from.
void keep_inputs(const anthrob::Dataset& made, const std::string& out,
                 const std::vector<std::string>& inputs) {
  std::vector<std::string> written = {"meta.yaml"}, read;
  for (const anthrob::Table& table : made.tables) written.push_back(table.name + ".csv");
  for (const std::string& input : inputs) read.push_back(anthrob::place_of(input).string());
  anthrob::require_kept(out, written, read);
}

/// CSV files of another program, as one dataset folder or, split, as one for each piece.
void convert_foreign(const std::string& in, const std::string& map, const std::string& out) {
  const anthrob::ForeignColumns columns = anthrob::ForeignColumns::load(map);
  const anthrob::Dataset whole = anthrob::read_foreign_csv(in, columns);
  std::vector<std::string> inputs = {map};
  for (const anthrob::ForeignStream& stream : columns.streams) {
    inputs.push_back(stream.file.empty() ? in : (std::filesystem::path(in) / stream.file).string());
  }
  std::vector<std::pair<std::string, anthrob::Dataset>> made;
  for (const anthrob::Piece& piece : columns.split) {
    made.emplace_back((std::filesystem::path(out) / piece.name).string(),
                      anthrob::cut(whole, piece));
  }
  if (made.empty()) made.emplace_back(out, whole);
  for (const auto& [folder, data] : made) keep_inputs(data, folder, inputs);
  for (const auto& [folder, data] : made) data.require_place(folder);
  for (const auto& [folder, data] : made) {
    data.save(folder);
    say_written(folder, data);
  }
}

/// The same of a bag, whose description is written beside it.
void keep_folder(const std::string& in, const std::filesystem::path& bag) {
  const std::string described = bag.stem().string() + ".yaml";
  const std::string folder = bag.has_parent_path() ? bag.parent_path().string() : ".";
  const std::filesystem::path from(in);
  const std::filesystem::path meta = std::filesystem::is_directory(from)
                                         ? from / "meta.yaml"
                                         : std::filesystem::path(from).replace_extension(".yaml");
  if (!std::filesystem::exists(meta)) return;  // a bag of ROS 2 need not have one
  anthrob::require_kept(folder, {described}, {anthrob::place_of(meta).string()});
}

}  // namespace

int main(int argc, char** argv) {
  using namespace anthrob;
  CLI::App app(
      "Converts a bag to a dataset folder or back; the bag is the one that ends in .bag. A bag of "
      "ROS 2 (.db3, or the folder of one) becomes either. With "
      "--columns, converts CSV files of another program to dataset folders.",
      "anthrob_convert");
  std::string in, out, columns;
  app.add_option("IN", in, "bag (of ROS 1 or 2), dataset folder, CSV file, or folder of CSV files")
      ->required();
  app.add_option("OUT", out, "dataset folder or bag")->required();
  app.add_option("--columns", columns,
                 "YAML file that says what the columns of the CSV file are (docs/files.md)");
  return tool::run(app, argc, argv, [&]() -> int {
    if (!columns.empty()) {
      convert_foreign(in, columns, out);
      return tool::kDone;
    }
    const auto is_bag = [](const std::string& path) {
      return std::filesystem::path(path).extension() == ".bag";
    };
    if (!std::filesystem::exists(in))
      throw BadInput(in + ": no such recording; expected a bag or a dataset folder");
    if (is_ros2_bag(out)) {
      throw BadInput("OUT " + out + ": bags of ROS 2 are read only; expected a dataset folder");
    }
    if (!is_ros2_bag(in) && is_bag(in) == is_bag(out)) {
      throw BadInput("IN " + in + ", OUT " + out +
                     ": expected one of them to end in .bag; for a CSV file, give --columns");
    }
    if (is_bag(out)) {
      const Dataset recording = load_recording(in);
      tool::say(app, recording.remarks);
      keep_folder(in, out);
      const BagRemarks done = write_bag(recording, out);
      say_written(out, recording);
      tool::say(app, done.remarks);
      say_not_carried(done.not_carried);
      return tool::kDone;
    }
    BagContents contents;
    if (is_ros2_bag(in)) {
      contents.dataset = read_ros2_bag(in, &contents.not_carried);
    } else {
      contents = read_bag(in);
    }
    tool::say(app, contents.dataset.remarks);
    contents.dataset.save(out);
    say_written(out, contents.dataset);
    say_not_carried(contents.not_carried);
    return tool::kDone;
  });
}
