#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/output/file.hpp"
#include "core/output/memory_file.hpp"
#include "core/output/source.hpp"

namespace talus::core {

/// The name of a frame's datasets: "000012".
std::string frame_name(std::int64_t frame);

/// fields.h5: the frames of every group's positions and fields.
///
///     /time            [frames]                 s
///     /frames_written  [1]                      frames that are complete; the others hold zeros
///     /<group>/cells   [cells, nodes a cell]    node indices
///     /<group>/position/000000, 000001, ...     [nodes, 3]                     m
///     /<group>/<field>/000000, 000001, ...      [nodes or cells, components]   unit: an attribute of
///     /<group>/<field>
///
/// One dataset a frame, because ParaView's Xdmf3 reader cannot read a part of a dataset. The HDF5 library
/// makes the file's structure once, before the first frame, in memory, from where it is copied. Frames are then
/// plain writes into the places reserved for them, so that a kill at any moment leaves a file that opens, and a
/// full disk is an error of a plain write. Frames not yet written take no disk space.
class FieldStore {
 public:
  /// @pre group names differ; a group without nodes is left out
  FieldStore(const std::filesystem::path& path, const std::vector<GroupDescription>& groups,
             std::int64_t frame_capacity);

  /// Places in the file, in bytes: of each frame, for the position and then each field of a group; empty for
  /// a group left out.
  using GroupPlaces = std::vector<std::vector<std::uint64_t>>;
  struct Layout {
    std::uint64_t time = 0, count = 0;
    std::vector<GroupPlaces> groups = {};
  };

  /// Where a dataset of `group` lies; `field` -1 is the position.
  struct Slot {
    std::size_t group = 0;
    std::int64_t field = -1;
  };
  /// Writes one dataset of the frame in progress. @pre values has its rows x components
  void write(const Slot& slot, std::span<const double> values);
  /// Closes the frame in progress, which counts from here on. @throws UsageError where the capacity is used
  /// up
  void end_frame(double time);
  /// No call may follow. @throws FileError where the system says only now that there was no room
  void close() { file_.close(); }
  std::int64_t frames_written() const { return frames_written_; }
  std::int64_t capacity() const { return capacity_; }

 private:
  static Layout reserve_all(const MemoryFile& memory, const std::vector<GroupDescription>& groups,
                            std::int64_t frames);
  void write_numbers(std::uint64_t offset, std::span<const double> values);

  std::int64_t capacity_ = 0;
  std::int64_t frames_written_ = 0;
  Layout layout_;
  OutputFile file_;
};

}  // namespace talus::core
