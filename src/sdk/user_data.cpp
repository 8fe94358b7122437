// SPDX-License-Identifier: Apache-2.0
#include "sdk/user_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <vector>

#include "base/input_files.h"

namespace oriel::sdk {
namespace {

using scene::Value;
using Bytes = std::vector<std::byte>;

/// Maximum size of a user data file.
constexpr std::size_t kLargestFile = 1u << 30;

template <class T>
void put(Bytes& bytes, std::size_t at, const T& value) {
  if (bytes.size() < at + sizeof value) bytes.resize(at + sizeof value);
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

miTag tag_of_name(Host& host, ParamType type, const std::string& name) {
  if (type == ParamType::String) return host.tag_of_text(name);
  if (type == ParamType::Data) return host.tag_of(host.scene().get<scene::UserData>(name));
  return miNULLTAG;
}

/// Stores a value at its offset in the C struct.
void put_value(Host& host, ParamType type, const Value& value, Bytes& bytes, std::size_t at) {
  if (value.kind == Value::Kind::Boolean) return put(bytes, at, miBoolean{value.boolean});
  if (value.kind == Value::Kind::Text) return put(bytes, at, tag_of_name(host, type, value.text));
  if (value.kind != Value::Kind::Numbers || value.numbers.empty()) return;
  if (type == ParamType::Integer || type == ParamType::Boolean)
    return put(bytes, at,
               static_cast<int>(std::clamp(value.numbers[0], -2147483648.0, 2147483647.0)));
  const std::size_t most = c_size(type) / sizeof(miScalar);
  for (std::size_t i = 0; i < std::min(most, value.numbers.size()); ++i)
    put(bytes, at + i * sizeof(miScalar), static_cast<miScalar>(value.numbers[i]));
  if (type == ParamType::Color && value.numbers.size() == 3) put(bytes, at + 12, miScalar{1});
}

/// The argument of a member, "outer.inner" within structs.
const Value* find(const std::vector<scene::Argument>& arguments, std::string_view name) {
  for (const scene::Argument& a : arguments) {
    if (a.name == name) return &a.value;
    if (a.value.kind == Value::Kind::Struct && name.size() > a.name.size() &&
        name[a.name.size()] == '.' && name.substr(0, a.name.size()) == a.name)
      return find(a.value.members, name.substr(a.name.size() + 1));
  }
  return nullptr;
}

void put_default(Host& host, const ParamSpec& row, Bytes& bytes, std::size_t at) {
  Value value;
  if (row.type == ParamType::String) {
    value.kind = Value::Kind::Text;
    value.text = row.text ? row.text : "";
  } else if (row.declared_default && c_size(row.type) <= sizeof(miColor)) {
    value.kind = Value::Kind::Numbers;
    const std::size_t count = c_size(row.type) / sizeof(miScalar);
    value.numbers.assign(row.fallback.begin(), row.fallback.begin() + static_cast<long>(count));
    if (row.type == ParamType::Color && row.fallback[3] == 0) value.numbers.pop_back();
  }
  put_value(host, row.type, value, bytes, at);
}

void put_array(Host& host, const CMember& m, const ParamSpec& row, const Value& value,
               Bytes& bytes) {
  if (m.c_stride == 0) return;
  const std::size_t first = m.c_offset + 8;
  const std::size_t begin = begin_of_array(m, bytes.size());
  put(bytes, m.c_offset, static_cast<int>((begin - first) / m.c_stride));
  put(bytes, m.c_offset + 4, static_cast<int>(value.items.size()));
  bytes.resize(begin + value.items.size() * m.c_stride);
  for (std::size_t i = 0; i < value.items.size(); ++i)
    for (std::size_t k = 0; k < m.members.size(); ++k) {
      const std::size_t at = begin + i * m.c_stride + m.members[k].c_offset;
      const Value& item = value.items[i];
      if (row.members.empty()) {
        put_value(host, m.members[k].type, item, bytes, at);
        continue;
      }
      put_default(host, row.members[k], bytes, at);
      if (const Value* v = find(item.members, row.members[k].name))
        put_value(host, m.members[k].type, *v, bytes, at);
    }
}

Bytes declared(const scene::UserData& data, const UserSpec& layout, Host& host) {
  Bytes bytes(layout.c_params_size);
  for (std::size_t i = 0; i < layout.members.size(); ++i) {
    const CMember& m = layout.members[i];
    const Value* value = find(data.arguments, layout.rows[i].name);
    if (m.type == ParamType::Array) {
      if (value) put_array(host, m, layout.rows[i], *value, bytes);
      continue;
    }
    put_default(host, layout.rows[i], bytes, m.c_offset);
    if (value) put_value(host, m.type, *value, bytes, m.c_offset);
  }
  return bytes;
}

Bytes of_file(const scene::UserData& data, Host& host) {
  namespace fs = std::filesystem;
  const fs::path path = fs::path(data.directory) / data.file;  // absolute names are kept
  OpenFile file = host.scene().files.open(path.string(), FileUse::Scene);
  std::string reason = file.reason();
  if (file && file.size() > kLargestFile) reason = "it is larger than 1 GB";
  if (reason.empty()) {
    note_input_file(path.string(), InputKind::Frame);
    const std::string content = file.read(kLargestFile);
    if (content.size() == file.size()) {
      const auto* first = reinterpret_cast<const std::byte*>(content.data());
      return {first, first + content.size()};
    }
    reason = "it ends early";
  }
  host.diagnostics().warning("OR-SDK-012", data.where,
                             fmt::format("the file \"{}\" of user data \"{}\" cannot be read: {}",
                                         data.file, data.name, reason),
                             file.hint());
  return {};
}

}  // namespace

std::unique_ptr<std::byte[]> user_data_record(const scene::UserData& data, Host& host,
                                              std::size_t& size) {
  const UserSpec* layout = host.data_layout(data.declaration);
  Bytes parameters;
  if (layout) {
    parameters = declared(data, *layout, host);
  } else if (!data.declaration.empty()) {
    host.diagnostics().warning("OR-SDK-013", data.where,
                               fmt::format("`declare data \"{}\"` is missing", data.declaration),
                               "its parameters are not available to shaders");
  } else if (!data.file.empty()) {
    parameters = of_file(data, host);
  } else {
    const std::size_t written = static_cast<std::size_t>(std::max(data.size.value_or(0), 0));
    const std::size_t count = std::min(std::max(written, data.bytes.size()), std::size_t{1} << 30);
    parameters.resize(count);
    if (!data.bytes.empty()) std::memcpy(parameters.data(), data.bytes.data(), data.bytes.size());
  }
  constexpr std::size_t kHead = offsetof(miUserdata, parameters);
  size = kHead + parameters.size();
  auto record = std::make_unique<std::byte[]>(std::max(size, sizeof(miUserdata)));
  miUserdata head = {};
  if (layout) head.data_decl = host.tag_of(*layout);
  head.next_data = host.tag_of_name(data.next);
  head.label = data.label.value_or(0);
  head.parameter_size = static_cast<int>(parameters.size());
  std::memcpy(record.get(), &head, sizeof head);
  if (!parameters.empty()) std::memcpy(record.get() + kHead, parameters.data(), parameters.size());
  return record;
}

miTag attached_data(const scene::Attachments& attachments, Host& host) {
  return attachments.data.empty() ? miNULLTAG : host.tag_of_name(attachments.data);
}

}  // namespace oriel::sdk
