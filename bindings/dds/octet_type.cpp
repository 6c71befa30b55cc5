// The functions that Cyclone calls for messages and types. They must not throw.
#include "bindings/dds/octet_type.hpp"

#include <dds/ddsi/q_radmin.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>
#include <vector>

namespace nezumi::dds {
namespace {

// A message as Cyclone stores it: without a key, opaque.
struct Octeted : ddsi_serdata {
    std::vector<std::uint8_t> bytes;  // with the header, padded to a multiple of 4 as in the protocol

    Octeted(const ddsi_sertype* its_type, ddsi_serdata_kind its_kind) : ddsi_serdata{} {
        ddsi_serdata_init(this, its_type, its_kind);
    }
    void resize(std::size_t size) {
        size_ = size;
        bytes.assign((size + 3) / 4 * 4, 0);
    }
    std::size_t size() const { return size_; }

private:
    std::size_t size_ = 0;
};

const Octeted& octeted(const ddsi_serdata* data) { return *static_cast<const Octeted*>(data); }

// A message of any size, or none if memory is exhausted: a C library calls this, so it must not throw.
template <class Fill>
ddsi_serdata* make_data(const ddsi_sertype* type, ddsi_serdata_kind kind, std::size_t size, const Fill& fill) {
    try {
        auto made = std::make_unique<Octeted>(type, kind);
        made->resize(size);
        if (!fill(*made)) return nullptr;
        return made.release();
    } catch (const std::bad_alloc&) {
        return nullptr;
    }
}

bool same_key(const ddsi_serdata* /*a*/, const ddsi_serdata* /*b*/) { return true; }

std::uint32_t size_of(const ddsi_serdata* data) { return static_cast<std::uint32_t>(octeted(data).size()); }

ddsi_serdata* from_fragments(const ddsi_sertype* type, ddsi_serdata_kind kind, const nn_rdata* fragment,
                             std::size_t size) {
    return make_data(type, kind, size, [&](Octeted& made) {
        std::uint32_t at = 0;
        for (; fragment != nullptr; fragment = fragment->nextfrag) {
            if (fragment->maxp1 <= at) continue;
            if (fragment->min > at || fragment->maxp1 > size) return false;
            const unsigned char* payload = NN_RMSG_PAYLOADOFF(fragment->rmsg, NN_RDATA_PAYLOAD_OFF(fragment));
            std::memcpy(made.bytes.data() + at, payload + (at - fragment->min), fragment->maxp1 - at);
            at = fragment->maxp1;
        }
        return at == size;
    });
}

ddsi_serdata* from_pieces(const ddsi_sertype* type, ddsi_serdata_kind kind, ddsrt_msg_iovlen_t count,
                          const ddsrt_iovec_t* pieces, std::size_t size) {
    return make_data(type, kind, size, [&](Octeted& made) {
        std::size_t at = 0;
        for (ddsrt_msg_iovlen_t i = 0; i < count && at < size; ++i) {
            const std::size_t taken = std::min<std::size_t>(pieces[i].iov_len, size - at);
            std::memcpy(made.bytes.data() + at, pieces[i].iov_base, taken);
            at += taken;
        }
        return at == size;
    });
}

ddsi_serdata* from_key_hash(const ddsi_sertype* type, const ddsi_keyhash* /*hash*/) {
    return make_data(type, SDK_KEY, 0, [](Octeted&) { return true; });
}

ddsi_serdata* from_sample(const ddsi_sertype* type, ddsi_serdata_kind kind, const void* sample) {
    if (kind != SDK_DATA) return make_data(type, kind, 0, [](Octeted&) { return true; });
    const auto& cdr = *static_cast<const std::span<const std::uint8_t>*>(sample);
    return make_data(type, kind, cdr.size(), [&](Octeted& made) {
        std::copy(cdr.begin(), cdr.end(), made.bytes.begin());
        return true;
    });
}

void to_octets(const ddsi_serdata* data, std::size_t offset, std::size_t size, void* out) {
    std::memcpy(out, octeted(data).bytes.data() + offset, size);
}

ddsi_serdata* lend_octets(const ddsi_serdata* data, std::size_t offset, std::size_t size, ddsrt_iovec_t* lent) {
    lent->iov_base = const_cast<std::uint8_t*>(octeted(data).bytes.data() + offset);
    lent->iov_len = static_cast<ddsrt_iov_len_t>(size);
    return ddsi_serdata_ref(data);
}

void take_octets_back(ddsi_serdata* data, const ddsrt_iovec_t* /*lent*/) { ddsi_serdata_unref(data); }

// Messages are taken unchanged (dds_takecdr). Only filters ask for a sample, which is a view of the bytes.
using View = std::span<const std::uint8_t>;
bool to_sample(const ddsi_serdata* data, void* sample, void** /*buffer*/, void* /*limit*/) {
    if (sample == nullptr) return false;
    *static_cast<View*>(sample) = octets_of(*data);
    return true;
}
bool key_to_sample(const ddsi_sertype* /*type*/, const ddsi_serdata* /*data*/, void* /*sample*/, void** /*buffer*/,
                   void* /*limit*/) {
    return true;
}

ddsi_serdata* without_type(const ddsi_serdata* data) {
    ddsi_serdata* made = make_data(data->type, SDK_KEY, 0, [](Octeted&) { return true; });
    if (made != nullptr) made->type = nullptr;
    return made;
}

void free_data(ddsi_serdata* data) { delete static_cast<Octeted*>(data); }

std::size_t print_data(const ddsi_sertype* /*type*/, const ddsi_serdata* data, char* out, std::size_t size) {
    return static_cast<std::size_t>(std::snprintf(out, size, "%u octets", size_of(data)));
}

void key_hash(const ddsi_serdata* /*data*/, ddsi_keyhash* out, bool /*by_md5*/) {
    std::memset(out->value, 0, sizeof out->value);
}

const ddsi_serdata_ops data_operations = [] {
    ddsi_serdata_ops all{};
    all.eqkey = same_key;
    all.get_size = size_of;
    all.from_ser = from_fragments;
    all.from_ser_iov = from_pieces;
    all.from_keyhash = from_key_hash;
    all.from_sample = from_sample;
    all.to_ser = to_octets;
    all.to_ser_ref = lend_octets;
    all.to_ser_unref = take_octets_back;
    all.to_sample = to_sample;
    all.to_untyped = without_type;
    all.untyped_to_sample = key_to_sample;
    all.free = free_data;
    all.print = print_data;
    all.get_keyhash = key_hash;
    return all;
}();

void free_type(ddsi_sertype* type) {
    ddsi_sertype_fini(type);
    delete type;
}
void zero_samples(const ddsi_sertype* /*type*/, void* /*samples*/, std::size_t /*count*/) {}
// Filters ask for one sample at a time.
void realloc_samples(void** samples, const ddsi_sertype* /*type*/, void* old, std::size_t /*before*/,
                     std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) samples[i] = nullptr;
    if (old == nullptr && count == 1) samples[0] = new (std::nothrow) View;
}
void free_samples(const ddsi_sertype* /*type*/, void** samples, std::size_t count, dds_free_op_t how) {
    if (count == 1 && (how & DDS_FREE_ALL_BIT) != 0) delete static_cast<View*>(samples[0]);
}
bool same_type(const ddsi_sertype* /*a*/, const ddsi_sertype* /*b*/) {
    return true;
}  // the names are compared elsewhere
std::uint32_t hash_of_type(const ddsi_sertype* /*type*/) { return 0; }
ddsi_sertype* derive_type(const ddsi_sertype* type, dds_data_representation_id_t representation,
                          dds_type_consistency_enforcement_qospolicy_t /*how*/) {
    // The bytes are plain CDR, which is valid as XCDR1 and XCDR2.
    return representation == DDS_DATA_REPRESENTATION_XCDR1 || representation == DDS_DATA_REPRESENTATION_XCDR2
               ? const_cast<ddsi_sertype*>(type)
               : nullptr;
}

const ddsi_sertype_ops type_operations = [] {
    ddsi_sertype_ops all{};
    all.version = ddsi_sertype_v0;
    all.free = free_type;
    all.zero_samples = zero_samples;
    all.realloc_samples = realloc_samples;
    all.free_samples = free_samples;
    all.equal = same_type;
    all.hash = hash_of_type;
    all.derive_sertype = derive_type;
    return all;
}();

}  // namespace

ddsi_sertype* make_octet_type(const char* name) {
    auto type = std::make_unique<ddsi_sertype>();
    ddsi_sertype_init(type.get(), name, &type_operations, &data_operations, true);
    type->allowed_data_representation = DDS_DATA_REPRESENTATION_FLAG_XCDR1;
    return type.release();
}

std::span<const std::uint8_t> octets_of(const ddsi_serdata& data) {
    const Octeted& its = octeted(&data);
    return {its.bytes.data(), its.size()};
}

}  // namespace nezumi::dds
