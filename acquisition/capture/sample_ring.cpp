#include "acquisition/capture/sample_ring.hpp"

#include <new>
#include <sys/mman.h>
#include <sys/shm.h>
#include <type_traits>
#include <unistd.h>

namespace axiscal {
namespace {

static_assert(std::is_trivially_copyable_v<Sample>);

constexpr std::size_t given_back_bytes = std::size_t{64} * 4096; ///< a system call for thousands

/// The next count of samples that fills whole pages.
std::size_t places_of(std::size_t capacity) {
    const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    while (capacity * sizeof(Sample) % page != 0)
        ++capacity;
    return capacity;
}

/// Without a file: memory must not depend on how long a file may be, as a full disk is tried with.
bool map_memory_twice(std::byte* place, std::size_t bytes) {
    constexpr int shared = MAP_SHARED | MAP_ANONYMOUS | MAP_FIXED;
    // mremap(2): of a length of 0, pages that are shared are seen at the new place as well.
    return ::mmap(place, bytes, PROT_READ | PROT_WRITE, shared, -1, 0) != MAP_FAILED &&
           ::mremap(place, 0, bytes, MREMAP_MAYMOVE | MREMAP_FIXED, place + bytes) != MAP_FAILED;
}

/// Where the kernel's calls are emulated (qemu-user), mremap refuses a length of 0.
bool map_segment_twice(std::byte* place, std::size_t bytes) {
    const int segment = ::shmget(IPC_PRIVATE, bytes, IPC_CREAT | 0600);
    if (segment < 0) return false;
    bool mapped = true;
    for (std::byte* const copy : {place, place + bytes})
        mapped = mapped && ::shmat(segment, copy, SHM_REMAP) == copy;
    ::shmctl(segment, IPC_RMID, nullptr); // gone with its last mapping
    return mapped;
}

} // namespace

void SampleRing::Unmap::operator()(Sample* places) const {
    ::munmap(places, 2 * bytes);
}

std::unique_ptr<Sample[], SampleRing::Unmap> SampleRing::mapped_twice(std::size_t bytes) {
    void* const place = ::mmap(nullptr, 2 * bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (place == MAP_FAILED) throw std::bad_alloc{};
    std::unique_ptr<Sample[], Unmap> places{static_cast<Sample*>(place), Unmap{bytes}};
    auto* const first = static_cast<std::byte*>(place);
    if (!map_memory_twice(first, bytes) && !map_segment_twice(first, bytes)) throw std::bad_alloc{};
    return places;
}

SampleRing::SampleRing(std::size_t capacity)
    : count_{places_of(capacity)}
    , step_{places_of(given_back_bytes / sizeof(Sample))}
    , places_{mapped_twice(count_ * sizeof(Sample))} {}

void SampleRing::push(const Sample& sample) {
    // The second copy would do as well, but its pages would have to be mapped too.
    const std::size_t at = first_ + size_;
    ::new (&places_[at < count_ ? at : at - count_]) Sample{sample};
    ++size_;
}

void SampleRing::pop() {
    ++first_;
    --size_;
    if (first_ - passed_ == step_ || first_ == count_) give_back_passed();
    if (first_ == count_) first_ = passed_ = 0;
}

// A ring that is nearly full has its newest samples in the places just passed, by the second copy:
// these pages are needed. Where the kernel refuses, they are only kept.
void SampleRing::give_back_passed() {
    const bool newest_behind = first_ + size_ > count_ + passed_;
    if (!newest_behind)
        ::madvise(&places_[passed_], (first_ - passed_) * sizeof(Sample), MADV_REMOVE);
    passed_ = first_;
}

} // namespace axiscal
