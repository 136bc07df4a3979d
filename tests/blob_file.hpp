// A blob in memory, to be looked into and forged.
#pragma once
#include <doctest/doctest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "minirt.h"

namespace test {

/// A blob in memory aligned as a mapped file is.
class Blob {
public:
    explicit Blob(const std::vector<char>& bytes) : size_(bytes.size()), rows_((bytes.size() + 15) / 16) {
        std::memcpy(data(), bytes.data(), size_);
    }

    static Blob read(const std::filesystem::path& path) {
        std::ifstream file(path, std::ios::binary);
        return Blob(std::vector<char>(std::istreambuf_iterator<char>(file), {}));
    }
    void write(const std::filesystem::path& path) {
        std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(data()), static_cast<std::streamsize>(size_));
    }

    uint8_t* data() { return reinterpret_cast<uint8_t*>(rows_.data()); }
    size_t size() const { return size_; }
    minirt_blob_header& header() { return *reinterpret_cast<minirt_blob_header*>(data()); }
    minirt_blob_section* table() { return reinterpret_cast<minirt_blob_section*>(data() + sizeof(minirt_blob_header)); }

    minirt_blob_section& section(const char* tag) {
        for (uint32_t i = 0; i < header().section_count; ++i)
            if (std::string(table()[i].tag, 8).compare(0, std::strlen(tag), tag) == 0) return table()[i];
        throw std::runtime_error("no section " + std::string(tag));
    }
    template <typename T>
    T* contents(const char* tag) {
        return reinterpret_cast<T*>(data() + section(tag).offset);
    }

    minirt_result validate(std::string* message = nullptr) { return validate(size_, message); }
    minirt_result validate(size_t size, std::string* message = nullptr) {
        minirt_blob blob;
        minirt_validation validation;
        const minirt_result result = minirt_validate(data(), size, &blob, &validation);
        if (message) *message = validation.message;
        CHECK((result == MINIRT_OK) == (blob.nodes != nullptr));
        return result;
    }

    /// Makes all checksums right again.
    void seal() {
        const auto align = [](uint64_t size) {
            return (size + MINIRT_SECTION_ALIGNMENT - 1) / MINIRT_SECTION_ALIGNMENT * MINIRT_SECTION_ALIGNMENT;
        };
        const uint64_t headerSize = align(sizeof(minirt_blob_header) + header().section_count * sizeof(minirt_blob_section));
        if (headerSize > size_) return;
        for (uint32_t i = 0; i < header().section_count; ++i) {
            minirt_blob_section& s = table()[i];
            if (s.offset <= size_ && s.size <= size_ && align(s.size) <= size_ - s.offset)
                s.checksum = minirt_checksum(data() + s.offset, align(s.size));
        }
        header().checksum = minirt_header_checksum(data(), headerSize);
    }

private:
    struct alignas(16) Row {
        uint8_t bytes[16];
    };
    size_t size_;
    std::vector<Row> rows_;
};

/// The names of the kernels that a blob holds.
inline std::set<std::string> kernelNames(Blob blob) {
    std::set<std::string> names;
    const uint64_t count = blob.section("KERNELS").size / sizeof(minirt_kernel);
    for (uint64_t i = 0; i < count; ++i) names.insert(blob.contents<minirt_kernel>("KERNELS")[i].name);
    return names;
}

}  // namespace test
