// plot_folder.hpp: the folder of pictures, which only ever loses files of its own kind.
#pragma once

#include <filesystem>

namespace signorini {

/// A script or what it draws: .gp, .svg, .png.
[[nodiscard]] bool is_picture(const std::filesystem::path& file);

/// A frame for ParaView, or their list.
[[nodiscard]] bool is_paraview(const std::filesystem::path& file);

/// Removes the files that `ours` names, and the folder if that empties it; nothing where there is no folder.
/// Errors: FileError.
void clear_plot_folder(const std::filesystem::path& folder, bool (*ours)(const std::filesystem::path&));

/// The folder, there and without earlier files of ours. Errors: FileError.
void begin_plot_folder(const std::filesystem::path& folder, bool (*ours)(const std::filesystem::path&));

}  // namespace signorini
