// Memory of images: on huge pages, committed by the thread that first writes a pixel, and used again by the next frame.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <new>
#include <span>
#include <utility>

namespace rawtexel::shading {

/// `bytes` of memory with anything in it. Throws std::bad_alloc.
void* allocate_pixels(size_t bytes);
/// Gives back what allocate_pixels(bytes) gave. The last large block is kept for the next image of its size. Safe on any thread.
void free_pixels(void* memory, size_t bytes) noexcept;

struct FreePixels {
    size_t bytes = 0;
    void operator()(float* memory) const noexcept { free_pixels(memory, bytes); }
};

/// An array of floats in such memory. Made of a size alone it holds anything: whoever writes all pixels need not wait for one thread to
/// zero them, which would take a tenth of the time of a simple frame.
class PixelValues {
  public:
    PixelValues() = default;
    /// Throws std::bad_alloc.
    explicit PixelValues(size_t size)
        : memory_(static_cast<float*>(allocate_pixels(bytes_of(size))), FreePixels{bytes_of(size)}), size_(size) {}
    PixelValues(size_t size, float value) : PixelValues(size) { std::fill_n(data(), size, value); }
    explicit PixelValues(std::span<const float> values) : PixelValues(values.size()) { std::ranges::copy(values, data()); }
    PixelValues(std::initializer_list<float> values) : PixelValues(std::span(values.begin(), values.size())) {}
    PixelValues(const PixelValues& other) : PixelValues(other.size()) { std::copy_n(other.data(), size_, data()); }
    PixelValues(PixelValues&& other) noexcept : memory_(std::move(other.memory_)), size_(std::exchange(other.size_, 0)) {}
    PixelValues& operator=(PixelValues other) noexcept {
        memory_ = std::move(other.memory_);
        size_ = other.size_;
        return *this;
    }

    float* data() { return memory_.get(); }
    const float* data() const { return memory_.get(); }
    size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    float* begin() { return data(); }
    float* end() { return data() + size_; }
    const float* begin() const { return data(); }
    const float* end() const { return data() + size_; }
    float& operator[](size_t i) { return data()[i]; }
    const float& operator[](size_t i) const { return data()[i]; }
    bool operator==(const PixelValues& other) const { return std::ranges::equal(*this, other); }
    bool operator==(std::span<const float> other) const { return std::ranges::equal(*this, other); }

  private:
    static size_t bytes_of(size_t size) {
        if (size > SIZE_MAX / sizeof(float)) throw std::bad_alloc();
        return size * sizeof(float);
    }

    std::unique_ptr<float[], FreePixels> memory_;
    size_t size_ = 0;
};

}  // namespace rawtexel::shading
