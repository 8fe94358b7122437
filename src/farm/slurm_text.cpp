// SPDX-License-Identifier: Apache-2.0
#include "farm/slurm_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace oriel::farm {
namespace {

constexpr std::size_t kMaxTasks = 4'000'000;  // Slurm's own limit of MaxArraySize is 4000001

std::optional<int> slurm_number(std::string_view text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || number < 0) return std::nullopt;
  return number;
}

std::vector<std::string_view> split_text(std::string_view text, char at) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = text.find(at);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

/// Tasks of an id: 12, 12_3 or 12_[3-5].
std::vector<SlurmTask> tasks_of_id(std::string_view id) {
  const std::size_t line = id.find('_');
  const std::string_view job = id.substr(0, line);
  if (!slurm_number(job)) return {};
  if (line == std::string_view::npos) return {{std::string(job), -1, {}, {}, {}}};
  std::string_view list = id.substr(line + 1);
  if (list.starts_with('[') && list.ends_with(']')) list = list.substr(1, list.size() - 2);
  std::vector<SlurmTask> tasks;
  if (const auto numbers = parse_task_list(list))
    for (const int number : *numbers) tasks.push_back({std::string(job), number, {}, {}, {}});
  return tasks;
}

void append_tasks(std::vector<SlurmTask>& all, std::string_view id, std::string_view state,
                  std::string_view reason, std::string_view exit_code) {
  for (SlurmTask& task : tasks_of_id(id)) {
    task.state = state.substr(0, state.find(' '));  // "CANCELLED by 0"
    task.reason = reason;
    task.exit_code = exit_code;
    all.push_back(std::move(task));
  }
}

}  // namespace

std::vector<SlurmTask> parse_squeue(std::string_view text) {
  std::vector<SlurmTask> all;
  for (const std::string_view line : split_text(text, '\n')) {
    const auto parts = split_text(line, '|');
    if (parts.size() >= 3) append_tasks(all, parts[0], parts[1], parts[2], {});
  }
  return all;
}

std::vector<SlurmTask> parse_sacct(std::string_view text) {
  std::vector<SlurmTask> all;
  for (const std::string_view line : split_text(text, '\n')) {
    const auto parts = split_text(line, '|');
    if (parts.size() >= 3) append_tasks(all, parts[0], parts[1], {}, parts[2]);
  }
  return all;
}

std::string parse_job_id(std::string_view text) {
  const std::string_view id = text.substr(0, text.find_first_of(";\r\n"));
  return slurm_number(id) ? std::string(id) : std::string();
}

std::optional<int> parse_config_number(std::string_view text, std::string_view key) {
  for (std::string_view line : split_text(text, '\n')) {
    if (!line.starts_with(key)) continue;
    line.remove_prefix(key.size());
    const std::size_t digits = line.find_first_not_of(' ');
    if (digits == line.npos || line[digits] != '=') continue;
    line.remove_prefix(digits + 1);
    const std::size_t begin = line.find_first_not_of(' '), end = line.find_last_not_of(" \r");
    if (begin != line.npos) return slurm_number(line.substr(begin, end - begin + 1));
  }
  return std::nullopt;
}

std::optional<std::vector<int>> parse_task_list(std::string_view text) {
  std::vector<int> numbers;
  text = text.substr(0, text.find('%'));
  for (const std::string_view range : split_text(text, ',')) {
    const std::size_t colon = range.find(':'), dash = range.find('-');
    const std::string_view ends = range.substr(0, colon);
    const auto first = slurm_number(ends.substr(0, dash));
    const auto last =
        dash == ends.npos ? first : slurm_number(ends.substr(std::min(dash + 1, ends.size())));
    const auto step =
        colon == range.npos ? std::optional(1) : slurm_number(range.substr(colon + 1));
    if (!first || !last || !step || *step < 1 || *last < *first) return std::nullopt;
    if (numbers.size() + static_cast<std::size_t>((*last - *first) / *step) >= kMaxTasks)
      return std::nullopt;
    for (long at = *first; at <= *last; at += *step) numbers.push_back(static_cast<int>(at));
  }
  return numbers;
}

std::string task_list(const std::vector<int>& tasks) {
  std::string text;
  for (std::size_t i = 0; i < tasks.size();) {
    std::size_t end = i + 1;
    while (end < tasks.size() && tasks[end] == tasks[end - 1] + 1) ++end;
    if (!text.empty()) text += ',';
    text +=
        end - i == 1 ? fmt::format("{}", tasks[i]) : fmt::format("{}-{}", tasks[i], tasks[end - 1]);
    i = end;
  }
  return text;
}

}  // namespace oriel::farm
