#include "anthrob_calib/resume/fingerprint.h"

#include <elf.h>
#include <link.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iterator>
#include <sstream>

namespace anthrob {
namespace resume {

namespace {

std::string content(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void add_named_files(const ConfigNode& node, Fingerprint& fingerprint) {
  if (node.is_map()) {
    for (const auto& [key, child] : node.entries()) add_named_files(child, fingerprint);
  } else if (node.is_sequence()) {
    for (const ConfigNode& item : node.items()) add_named_files(item, fingerprint);
  } else if (node.is_scalar()) {
    const auto file = std::filesystem::path(node.file()).parent_path() / node.as_text();
    std::error_code none;
    if (std::filesystem::is_regular_file(file, none)) fingerprint.add(content(file));
  }
}

constexpr std::size_t padded(std::size_t size) {
  return (size + 3) / 4 * 4;
}

/// The mark that the linker gave to each version of a file: note "GNU", NT_GNU_BUILD_ID.
int add_build_id(dl_phdr_info* info, std::size_t, void* fingerprint) {
  if (std::strncmp(info->dlpi_name, "linux-", 6) == 0) return 0;  // the kernel's
  for (int i = 0; i < info->dlpi_phnum; ++i) {
    const auto& segment = info->dlpi_phdr[i];
    if (segment.p_type != PT_NOTE) continue;
    const char* at = reinterpret_cast<const char*>(info->dlpi_addr + segment.p_vaddr);
    const char* const end = at + segment.p_memsz;
    while (at + sizeof(ElfW(Nhdr)) <= end) {
      ElfW(Nhdr) note;
      std::memcpy(&note, at, sizeof(note));
      const char* const id = at + sizeof(note) + padded(note.n_namesz);
      if (note.n_type == NT_GNU_BUILD_ID) {
        static_cast<Fingerprint*>(fingerprint)->add(id, note.n_descsz);
      }
      at = id + padded(note.n_descsz);
    }
  }
  return 0;
}

}  // namespace

Fingerprint& Fingerprint::add(const void* bytes, std::size_t count) {
  const auto* at = static_cast<const unsigned char*>(bytes);
  for (std::size_t i = 0; i < count; ++i) hash_ = (hash_ ^ at[i]) * 1099511628211ULL;
  return *this;
}

Fingerprint& Fingerprint::add(const std::string& text) {
  add(static_cast<std::uint64_t>(text.size()));
  return add(text.data(), text.size());
}

Fingerprint& Fingerprint::add(const Dataset& recording) {
  add(meta_text(recording.meta));
  for (const Table& table : recording.tables) {
    add(table.name).add(table.t.data(), table.t.size() * sizeof(table.t[0]));
    for (const Column& column : table.columns) {
      add(column.name).add(column.present.data(), column.present.size());
      for (std::size_t i = 0; i < column.values.size(); ++i) {
        if (column.present[i]) add(column.values[i]);
      }
    }
  }
  return *this;
}

std::string fingerprint_text(std::uint64_t fingerprint) {
  std::ostringstream text;
  text << std::hex << std::setw(16) << std::setfill('0') << fingerprint;
  return text.str();
}

std::uint64_t content_fingerprint(const Dataset& recording) {
  std::vector<std::uint64_t> columns;
  for (const Table& table : recording.tables) {
    for (const Column& column : table.columns) {
      Fingerprint fingerprint;
      fingerprint.add(column.name);
      bool any = false;
      for (std::size_t i = 0; i < column.values.size(); ++i) {
        if (!column.present[i]) continue;
        fingerprint.add(static_cast<std::uint64_t>(table.t[i] - recording.begin()));
        fingerprint.add(column.values[i]);
        any = true;
      }
      if (any) columns.push_back(fingerprint.value());
    }
  }
  std::sort(columns.begin(), columns.end());
  Fingerprint whole;
  for (const std::uint64_t column : columns) whole.add(column);
  return whole.value();
}

std::uint64_t model_fingerprint(const ConfigNode& model) {
  Fingerprint fingerprint;
  fingerprint.add(model.to_yaml());
  add_named_files(model.clone(), fingerprint);  // looking leaves traces
  return fingerprint.value();
}

std::uint64_t program_fingerprint() {
  Fingerprint fingerprint;
  dl_iterate_phdr(add_build_id, &fingerprint);
  return fingerprint.value();
}

std::uint64_t program_fingerprint(std::uint64_t program, const std::vector<std::string>& files) {
  if (files.empty()) return program;
  Fingerprint fingerprint;
  fingerprint.add(program);
  for (const std::string& file : files) fingerprint.add(content(file));
  return fingerprint.value();
}

}  // namespace resume
}  // namespace anthrob
