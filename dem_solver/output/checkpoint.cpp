#include "dem_solver/output/checkpoint.hpp"

#include <cstring>
#include <type_traits>

#include "core/errors.hpp"

namespace talus::dem {

namespace {

constexpr const char* owner = "dem_solver";

struct Save {
  core::CheckpointWriter& file;

  template <class T>
  void operator()(const std::string& name, const std::vector<T>& values) const {
    static_assert(std::is_trivially_copyable_v<T>);
    file.bytes(name, std::as_bytes(std::span(values)));
  }
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(const std::string& name, const T& value) const {
    file.bytes(name, std::as_bytes(std::span(&value, 1)));
  }
};

struct Restore {
  core::CheckpointReader& file;

  template <class T>
  void operator()(const std::string& name, std::vector<T>& values) const {
    const std::vector<std::byte> bytes = file.bytes(name);
    values.resize(bytes.size() / sizeof(T));
    copy(name, bytes, values.data(), values.size() * sizeof(T));
  }
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(const std::string& name, T& value) const {
    copy(name, file.bytes(name), &value, sizeof(T));
  }

 private:
  static void copy(const std::string& name, const std::vector<std::byte>& bytes, void* to, std::size_t size) {
    if (bytes.size() != size)
      throw core::ConfigError("the checkpoint belongs to another scene or program: " + name);
    if (size > 0) std::memcpy(to, bytes.data(), size);
  }
};

}  // namespace

void write_checkpoint(const ParticleSolver& solver, const std::filesystem::path& path,
                      const ArchiveMore& more) {
  core::CheckpointWriter file(path, owner);
  ParticleSolver::visit_state(solver, Save{file});
  if (more) more(file);
  file.commit();
}

void read_checkpoint(ParticleSolver& solver, const std::filesystem::path& path, const ArchiveMore& more) {
  core::CheckpointReader file(path, owner);
  ParticleSolver restored = solver;
  ParticleSolver::visit_state(restored, Restore{file});
  if (restored.law() != solver.law())
    throw core::ConfigError(path.string() + " belongs to another scene: its contacts have other terms");
  if (restored.spheres().size() != solver.spheres().size() ||
      restored.rocks().size() != solver.rocks().size() ||
      restored.boundary().node_count() != solver.boundary().node_count())
    throw core::ConfigError(path.string() +
                            " belongs to another scene: it has other numbers of spheres, rocks or nodes");
  restored.fit_to_state();
  if (more) more(file);
  solver = std::move(restored);
}

}  // namespace talus::dem
