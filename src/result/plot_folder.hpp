// plot_folder.hpp: the folder of pictures, from which only the program's own files are removed.
#pragma once

#include <filesystem>

namespace signorini {

/// True for a script or a picture: .gp, .svg, .png.
[[nodiscard]] bool is_picture(const std::filesystem::path& file);

/// True for a ParaView frame or the list of frames.
[[nodiscard]] bool is_paraview(const std::filesystem::path& file);

/// Removes the files selected by `ours`, and the folder if it is empty then; does nothing without a folder. Errors:
/// FileError.
void clear_plot_folder(const std::filesystem::path& folder, bool (*ours)(const std::filesystem::path&));

/// Creates the folder, or removes our earlier files from it. Errors: FileError.
void begin_plot_folder(const std::filesystem::path& folder, bool (*ours)(const std::filesystem::path&));

}  // namespace signorini
