#include "core/output/field_reader.hpp"

#include "core/output/field_store.hpp"
#include "core/output/hdf5_handle.hpp"

namespace talus::core {

struct FieldReader::File {
  Hdf5Handle file;
};

namespace {

using Shape = std::vector<hsize_t>;

Shape shape_of(hid_t dataset) {
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose, "a data space");
  Shape shape(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
  H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  return shape;
}

template <class Number>
std::vector<Number> numbers(hid_t parent, const std::string& name, hid_t type) {
  const Hdf5Handle dataset(H5Dopen2(parent, name.c_str(), H5P_DEFAULT), H5Dclose, name);
  std::size_t count = 1;
  for (const auto length : shape_of(dataset)) count *= length;
  std::vector<Number> values(count);
  if (H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    throw std::runtime_error("the HDF5 library cannot read " + name);
  return values;
}

/// The members of a group that are groups themselves, by name.
std::vector<std::string> subgroups(hid_t parent) {
  std::vector<std::string> names;
  const auto visit = [](hid_t, const char* name, const H5L_info_t*, void* found) {
    static_cast<std::vector<std::string>*>(found)->emplace_back(name);
    return herr_t{0};
  };
  hsize_t start = 0;
  H5Literate(parent, H5_INDEX_NAME, H5_ITER_INC, &start, visit, &names);
  std::erase_if(names, [&](const std::string& name) {
    H5O_info_t info;
    return H5Oget_info_by_name(parent, name.c_str(), &info, H5P_DEFAULT) < 0 || info.type != H5O_TYPE_GROUP;
  });
  return names;
}

std::string unit_of(hid_t series) {
  const Hdf5Handle attribute(H5Aopen(series, "unit", H5P_DEFAULT), H5Aclose, "the unit");
  const Hdf5Handle type(H5Aget_type(attribute), H5Tclose, "the unit's type");
  std::string unit(H5Tget_size(type), ' ');
  H5Aread(attribute, type, unit.data());
  return unit == " " ? "" : unit;
}

Shape frame_shape(hid_t series) {
  const Hdf5Handle first(H5Dopen2(series, frame_name(0).c_str(), H5P_DEFAULT), H5Dclose, "the first frame");
  return shape_of(first);
}

FieldDescription described_field(hid_t group, const std::string& name, hsize_t nodes) {
  const Hdf5Handle series(H5Gopen2(group, name.c_str(), H5P_DEFAULT), H5Gclose, name);
  const Shape shape = frame_shape(series);
  return {.name = name,
          .unit = unit_of(series),
          .components = static_cast<std::uint8_t>(shape.at(1)),
          .location = shape.at(0) == nodes ? FieldLocation::node : FieldLocation::cell};
}

GroupDescription described_group(hid_t file, const std::string& name) {
  const Hdf5Handle group(H5Gopen2(file, name.c_str(), H5P_DEFAULT), H5Gclose, name);
  GroupDescription description{
      .name = name, .cells = numbers<std::int64_t>(group, "cells", H5T_NATIVE_INT64), .fields = {}};
  const Hdf5Handle cells(H5Dopen2(group, "cells", H5P_DEFAULT), H5Dclose, "cells");
  description.kind = static_cast<CellKind>(shape_of(cells).at(1));
  const Hdf5Handle position(H5Gopen2(group, "position", H5P_DEFAULT), H5Gclose, "position");
  description.nodes = static_cast<std::int64_t>(frame_shape(position).at(0));
  for (const auto& field : subgroups(group))
    if (field != "position")
      description.fields.push_back(described_field(group, field, static_cast<hsize_t>(description.nodes)));
  return description;
}

}  // namespace

FieldReader::FieldReader(const std::filesystem::path& path)
    : file_(new File{{H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, path.string()}}) {
  const auto frames = numbers<std::int64_t>(file_->file, "frames_written", H5T_NATIVE_INT64).at(0);
  times_ = numbers<double>(file_->file, "time", H5T_NATIVE_DOUBLE);
  times_.resize(static_cast<std::size_t>(frames));
  for (const auto& name : subgroups(file_->file)) groups_.push_back(described_group(file_->file, name));
}

FieldReader::~FieldReader() = default;

std::vector<double> FieldReader::read(const GroupDescription& group, const std::string& series,
                                      std::int64_t frame) const {
  return numbers<double>(file_->file, group.name + "/" + series + "/" + frame_name(frame), H5T_NATIVE_DOUBLE);
}

}  // namespace talus::core
