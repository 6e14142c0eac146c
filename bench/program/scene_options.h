// The options by which a command is told its scene, camera, picture size and lights, and checks of option values.
#pragma once
#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <luxel/status.h>

#include "bench/scene/scene.h"

namespace luxel::program {

/// As they stand on the command line; empty: the scene's own.
struct SceneOptions {
  std::string scene, camera, size, sun, sky;
};

/// What they mean.
struct SceneChoice {
  int width = 0, height = 0;
  std::optional<scene::Camera> camera;
  std::optional<scene::Sun> sun;
  std::optional<scene::Sky> sky;
};

/// Adds --scene (required), --camera, --size, --sun and --sky.
void add_scene_options(CLI::App& command, SceneOptions& options, const char* size);

/// Errors: invalid_argument, naming the option, before any scene is read.
Result<SceneChoice> parse(const SceneOptions& options);

/// The scene with the camera and the lights that were chosen. Errors: as scene::scene_from.
Result<scene::Scene> read(const SceneOptions& options, const SceneChoice& choice);

/// Numbers between commas. Empty unless there are `count` and all are finite.
std::vector<double> numbers(std::string_view text, std::size_t count);

/// "--option: text is not understood; expected ..."
Status wrong(const char* option, const std::string& text, const char* expected);

/// One of a list of names.
template <class Names>
CLI::Validator one_of(const Names& names) {
  return CLI::Validator(
      [names](std::string& text) {
        if (std::find(names.begin(), names.end(), text) != names.end()) return std::string();
        return fmt::format("{} is not known; expected {}", text, fmt::join(names, ", "));
      },
      "");
}

/// A number from `least` to `most`.
CLI::Validator within(double least, double most, bool whole);

}  // namespace luxel::program
