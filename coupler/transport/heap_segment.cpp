#include <cstring>
#include <memory>
#include <new>

#include "coupler/transport/layout.hpp"
#include "coupler/transport/segment.hpp"

namespace talus::coupler::transport {
namespace {

constexpr std::align_val_t page{4096};

struct PageDeleter {
  void operator()(std::byte* bytes) const { ::operator delete(bytes, page); }
};
using Pages = std::unique_ptr<std::byte, PageDeleter>;

Pages zeroed_pages(std::size_t bytes) {
  Pages pages(static_cast<std::byte*>(::operator new(bytes, page)));
  std::memset(pages.get(), 0, bytes);
  return pages;
}

class HeapSegment final : public Segment {
 public:
  std::span<std::byte> control() override { return {control_.get(), sizeof(Control)}; }
  void create_data(std::size_t bytes) override {
    data_ = zeroed_pages(bytes);
    data_bytes_ = bytes;
  }
  void attach_data(std::size_t) override {}
  std::span<std::byte> data() override { return {data_.get(), data_bytes_}; }
  std::size_t real_bytes() const override { return sizeof(Control); }
  std::string name() const override { return "in this process"; }
  void remove_name() noexcept override {}

 private:
  Pages control_ = zeroed_pages(sizeof(Control));
  Pages data_;
  std::size_t data_bytes_ = 0;
};

}  // namespace

std::shared_ptr<Segment> create_heap_segment() {
  return std::make_shared<HeapSegment>();
}

}  // namespace talus::coupler::transport
