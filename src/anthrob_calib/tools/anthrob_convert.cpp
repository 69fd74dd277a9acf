// Recordings between bags and dataset folders.
#include <filesystem>
#include <iostream>

#include "anthrob_sim/core/errors.h"
#include "anthrob_sim/recording/bag.h"
#include "anthrob_sim/recording/dataset.h"
#include "anthrob_sim/tool/tool.h"

int main(int argc, char** argv) {
  using namespace anthrob;
  CLI::App app(
      "Converts a bag to a dataset folder, or a dataset folder to a bag (by the ending .bag).",
      "anthrob_convert");
  std::string in, out;
  app.add_option("IN", in, "bag or dataset folder")->required();
  app.add_option("OUT", out, "dataset folder or bag")->required();
  return tool::run(app, argc, argv, [&]() -> int {
    const auto is_bag = [](const std::string& path) {
      return std::filesystem::path(path).extension() == ".bag";
    };
    if (!std::filesystem::exists(in))
      throw BadInput(in + ": no such recording; expected a bag or a dataset folder");
    if (is_bag(in) == is_bag(out)) {
      throw BadInput("IN " + in + ", OUT " + out + ": expected one of them to end in .bag");
    }
    if (!is_bag(in)) {
      write_bag(Dataset::load(in), out);
      return tool::kDone;
    }
    const BagContents contents = read_bag(in);
    contents.dataset.save(out);
    for (const std::string& what : contents.not_carried)
      std::cout << "not carried: " << what << "\n";
    return tool::kDone;
  });
}
