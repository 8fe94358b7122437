// SPDX-License-Identifier: Apache-2.0
// oriel submit: a scene as a job of Slurm.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "base/durable_file.h"
#include "base/temporary_folder.h"
#include "convert_model.h"
#include "farm/child_process.h"
#include "farm/job_scripts.h"
#include "farm/pack_layout.h"
#include "farm/slurm_text.h"
#include "farm/work.h"
#include "frames.h"
#include "render_plan.h"
#include "scene_package.h"

namespace oriel::app {
namespace {

namespace fs = std::filesystem;

struct SubmitArguments {
  PackArguments pack;
  std::string output, job, frames;
  int parts = 0, retries = 2, mpi = 0;
  farm::JobResources resources;
  std::vector<std::string> sbatch, render;
  std::string stage;
  double stagger = 0;
  bool maps = false, dry_run = false;
};

/// The default of Slurm.
constexpr int kMaxArraySize = 1001;
constexpr int kPartsOfStills = 4;

/// Words of render that the job sets itself.
constexpr const char* kOwnOptions[] = {
    "-o",           "--output",  "--part",          "--frames", "--resume",
    "--checkpoint", "--threads", "--skip-existing", "--maps",   "--maps-only",
    "--live",       "--json",    "--denoise",       "--time",   "--stop-at-usr1"};

/// The name of the picture without its suffix and without # for the frame.
std::string plain_stem(const std::string& output) {
  std::string stem = fs::path(output).stem().string();
  std::erase(stem, '#');
  const std::size_t last = stem.find_last_not_of("._- ");
  return last == std::string::npos ? "oriel" : stem.substr(0, last + 1);
}

std::string name_of_job(const std::string& output) {
  std::string name = farm::plain_name(plain_stem(output));
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string_view("._-").find(static_cast<char>(c)) != std::string_view::npos;
  };
  std::replace_if(
      name.begin(), name.end(), [&](char c) { return !is_plain(c); }, '_');
  return name;
}

void check_word(const char* option, const std::string& text) {
  for (const unsigned char c : text)
    if (std::isalnum(c) == 0 &&
        std::string_view("_-.,:+").find(static_cast<char>(c)) == std::string_view::npos)
      throw UsageError(fmt::format("{} {}: write one word, as for sbatch", option, text));
}

/// Finds wrong options now instead of on the nodes.
void check_render_words(const std::vector<std::string>& render) {
  for (const std::string& word : render) {
    const std::string option = word.substr(0, word.find('='));
    if (std::find(std::begin(kOwnOptions), std::end(kOwnOptions), option) != std::end(kOwnOptions))
      throw UsageError(
          fmt::format("{} cannot be passed to oriel render: the job sets it, or it "
                      "applies to the finished picture",
                      option));
  }
  CLI::App program;
  add_render_command(program);
  std::vector<std::string> words = {"render", "scene.mi"};
  words.insert(words.end(), render.begin(), render.end());
  std::reverse(words.begin(), words.end());  // as CLI11 expects them
  try {
    program.parse(words);
  } catch (const CLI::ParseError& e) {
    throw UsageError(fmt::format("options for oriel render: {}", e.what()));
  }
}

int max_array_size() {
  const farm::ChildResult config =
      farm::run_child({"scontrol", "show", "config"}, farm::ChildOutput::Query);
  return farm::parse_config_number(config.out, "MaxArraySize").value_or(kMaxArraySize);
}

std::vector<int> frames_of(const SubmitArguments& a, int in_scene) {
  const FrameList list = a.frames.empty() ? FrameList() : FrameList(a.frames);
  std::vector<int> frames;
  for (int frame = 1; frame <= in_scene; ++frame)
    if (list.holds(frame)) frames.push_back(frame);
  if (frames.empty() ||
      (!a.frames.empty() && list.goes_on_from(in_scene + 1) && !a.frames.ends_with("..")))
    throw UserError(fmt::format("--frames {}: the scene has {} render statement{}", a.frames,
                                in_scene, in_scene == 1 ? "" : "s"));
  return frames;
}

farm::Job make_job(const SubmitArguments& a, const farm::PackReport& packed,
                   const std::string& folder) {
  farm::Job job;
  job.folder = folder;
  job.name = name_of_job(a.output);
  job.program = fs::read_symlink("/proc/self/exe").string();
  job.scene = packed.scene;
  job.frames = frames_of(a, packed.frames);
  const std::string output = fs::absolute(a.output).lexically_normal().string();
  job.output = output;
  for (const int frame : job.frames) job.outputs.push_back(frame_path(output, frame));
  job.mpi = a.mpi;
  int still = a.resources.nodes > 0 ? a.resources.nodes : kPartsOfStills;
  if (a.mpi > 0) still = 1;
  job.parts = a.parts > 0 ? a.parts : job.frames.size() == 1 ? still : 1;
  job.retries = a.retries;
  job.maps = a.maps && job.parts > 1;
  job.libraries = packed.has_libraries;
  job.code = packed.has_code;
  if (!a.stage.empty()) job.stage = fs::absolute(a.stage).string();
  job.stagger = a.stagger;
  job.render = a.render;
  job.resources = a.resources;
  for (const std::string& word : a.sbatch) job.resources.further.push_back(word);
  return job;
}

std::vector<int> all_tasks(const farm::Job& job) {
  std::vector<int> tasks(static_cast<std::size_t>(job.task_count()));
  for (std::size_t i = 0; i < tasks.size(); ++i) tasks[i] = static_cast<int>(i);
  return tasks;
}

void print_dry_run(const farm::Job& job) {
  if (job.maps) fmt::print("# {}\n{}\n", job.path("maps.sh"), maps_script(job));
  fmt::print("# {}\n{}\n# {}\n{}\n# commands\n", job.path("render.sh"), render_script(job),
             job.path("merge.sh"), merge_script(job));
  if (job.maps) fmt::print("{}\n", farm::shell_line(maps_submission(job)));
  fmt::print("{}\n{}\n",
             farm::shell_line(render_submission(job, all_tasks(job), job.maps ? "MAPSID" : "")),
             farm::shell_line(merge_submission(job, "JOBID")));
}

void check_arguments(const SubmitArguments& a) {
  for (const auto& [option, text] : {std::pair("--time", &a.resources.time),
                                     {"--partition", &a.resources.partition},
                                     {"--account", &a.resources.account},
                                     {"--mem", &a.resources.memory}})
    check_word(option, *text);
  if (fs::path(a.output).extension() != ".exr")
    throw UsageError(fmt::format(
        "-o {}: pictures of jobs are EXR files (.exr); oriel tonemap converts them", a.output));
  if (a.mpi > 0 && (a.parts > 1 || a.maps))
    throw UsageError(
        "--mpi renders each picture as a whole, with maps of its own: leave out --parts and "
        "--maps");
  check_render_words(a.render);
}

std::string counted(int count, const char* noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

/// The folder of a job that is being made, which is removed if the job is not submitted.
class JobFolder {
 public:
  explicit JobFolder(std::string path) : path_(std::move(path)) {}
  ~JobFolder() {
    std::error_code ignored;
    if (!kept_) fs::remove_all(path_, ignored);
  }
  JobFolder(const JobFolder&) = delete;
  JobFolder& operator=(const JobFolder&) = delete;
  void keep() { kept_ = true; }

 private:
  std::string path_;
  bool kept_ = false;
};

int run_submit(const SubmitArguments& a) {
  check_arguments(a);
  const bool has_slurm = farm::is_in_path("sbatch");
  if (!has_slurm && !a.dry_run)
    throw UserError(
        "sbatch is not in PATH: submit on a machine with Slurm's commands, try --dry-run, or "
        "start a cluster on this machine with tools/farm-up");
  const std::string folder = fs::absolute(a.job.empty() ? fs::path(a.output).parent_path() /
                                                              (plain_stem(a.output) + ".job")
                                                        : fs::path(a.job))
                                 .lexically_normal()
                                 .string();
  std::error_code error;
  if (fs::exists(folder, error))
    throw UserError(fmt::format("'{}' exists: see oriel status {}, or remove it", folder,
                                farm::shell_line({folder})));
  if (a.dry_run) {
    const TemporaryFolder trial;
    farm::Job job = make_job(a, pack(a.pack, trial.file("scene")), folder);
    job.chunk = farm::chunk_for(job.unit_count(), has_slurm ? max_array_size() : kMaxArraySize);
    print_dry_run(job);
    return kExitDone;
  }
  JobFolder made(folder);
  const farm::PackReport packed = pack(a.pack, folder + "/scene");
  farm::Job job = make_job(a, packed, folder);
  job.chunk = farm::chunk_for(job.unit_count(), max_array_size());
  for (const char* name : {"log", "maps", "parts", "units"}) fs::create_directories(job.path(name));
  fs::create_directories(fs::path(job.outputs[0]).parent_path());
  write_durably(job.path("render.sh"), render_script(job), 0777);
  write_durably(job.path("merge.sh"), merge_script(job), 0777);
  if (job.maps) write_durably(job.path("maps.sh"), maps_script(job), 0777);
  farm::write_job(job);
  const std::string id = farm::submit_tasks(job, all_tasks(job));
  made.keep();
  fmt::print("job {}: {} in {}; see oriel status {}\n", id,
             counted(job.unit_count(), job.parts > 1 ? "part" : "frame"),
             counted(job.task_count(), "task"), farm::shell_line({folder}));
  return kExitDone;
}

void add_resource_options(CLI::App& command, farm::JobResources& r) {
  command
      .add_option("--nodes", r.nodes,
                  "Maximum number of tasks that run at once (default: no limit)")
      ->check(CLI::Range(1, 1 << 20));
  command.add_option("--cpus", r.cpus, "Processors of each task (default: a whole node)")
      ->check(CLI::Range(1, 4096));
  command.add_option("--time", r.time,
                     "Time limit of a task, as for sbatch; a task that reaches it writes its "
                     "state and continues later (default: that of the partition)");
  command.add_option("--partition", r.partition, "Partition of Slurm (default: the cluster's)");
  command.add_option("--account", r.account, "Account of Slurm (default: the user's)");
  command.add_option("--mem", r.memory, "Memory of a node, as for sbatch (default: the cluster's)");
  command
      .add_option("--lead", r.lead,
                  "Seconds before the time limit at which tasks write their state (default 120)")
      ->check(CLI::Range(1, 65535));
}

}  // namespace

Command add_submit_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "submit", "Render a scene on a cluster: packs it and submits a job array to Slurm");
  auto a = std::make_shared<SubmitArguments>();
  add_pack_arguments(*command, a->pack);
  command
      ->add_option("-o,--output", a->output,
                   "Picture to write (.exr), on a file system that all nodes share; # is replaced "
                   "by digits of the frame number")
      ->required()
      ->type_name("FILE");
  command->add_option("--job", a->job, "Folder of the job (default: the picture's name with .job)")
      ->type_name("FOLDER");
  command->add_option("--frames", a->frames, "Frames to render, as in oriel render (default all)")
      ->type_name("A..B");
  command
      ->add_option("--parts", a->parts,
                   "Parts of each frame (default: 1; for a single frame --nodes, else 4)")
      ->check(CLI::Range(1, 100000));
  command->add_flag("--maps", a->maps,
                    "Compute photon maps and final gather points once for each frame, before its "
                    "parts, instead of once for each part");
  command
      ->add_option(
          "--mpi", a->mpi,
          "Nodes that render each picture together, by srun and Open MPI, instead of parts "
          "that are rendered independently")
      ->check(CLI::Range(1, 100000));
  add_resource_options(*command, a->resources);
  command
      ->add_option("--retries", a->retries,
                   "Times that missing parts are submitted again (default 2)")
      ->check(CLI::Range(0, 1000));
  command
      ->add_option("--stage", a->stage,
                   "Folder on the nodes, such as /tmp: the scene is copied to it once for each "
                   "node (default: it is read from the job's folder)")
      ->type_name("FOLDER");
  command
      ->add_option("--stagger", a->stagger,
                   "Seconds between the starts of two tasks, at most 600 in all (default 0)")
      ->check(CLI::Range(0.0, 600.0));
  command
      ->add_option("--sbatch", a->sbatch,
                   "Further option for sbatch, such as --sbatch=--nice=10; "
                   "repeatable")
      ->allow_extra_args(false)
      ->type_name("OPTION");
  command->add_flag("--dry-run", a->dry_run, "Print the scripts and commands, and submit nothing");
  command->add_option("OPTIONS", a->render, "After --: further options of oriel render")
      ->type_name("");
  return {command, [a] { return run_submit(*a); }};
}

}  // namespace oriel::app
