#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "core/output/source.hpp"

namespace talus::core {

/// fields.xdmf: tells ParaView what lies where in fields.h5. It lists complete frames only and is replaced in
/// one step.
///
/// The file grows with the number of frames, so that writing it for each of them would cost quadratically; it
/// is therefore written after a frame only where the time since the last writing is at least 20 times what
/// that writing took, and at the end. After a kill it may miss the last frames; they are in fields.h5 all the
/// same.
class FieldIndex {
 public:
  FieldIndex(const std::filesystem::path& path, const std::vector<GroupDescription>& groups);
  ~FieldIndex();
  void add_frame(double time);
  /// Writes the file with all frames added so far.
  void write();

 private:
  struct Document;
  std::unique_ptr<Document> document_;
};

}  // namespace talus::core
