// A text is a string, or a wide string, which programs in Java send.
#include "bindings/openrtm/orb/properties.hpp"

namespace nezumi::openrtm {

std::string text_of(const CORBA::Any& value) {
    const char* text = nullptr;
    if (value >>= text) return text;
    const CORBA::WChar* wide = nullptr;
    std::string narrow;
    if (value >>= wide) {
        for (; *wide != 0; ++wide) narrow += *wide < 0x80 ? static_cast<char>(*wide) : '?';
    }
    return narrow;
}

std::string text_of(const SDOPackage::NVList& list, std::string_view name) {
    for (CORBA::ULong i = 0; i < list.length(); ++i) {
        if (name == list[i].name.in()) return text_of(list[i].value);
    }
    return "";
}

std::string data_type_of(const RTC::PortProfile& port) {
    std::string type = text_of(port.properties, "dataport.data_type");
    type.erase(0, type.rfind('/') + 1);
    return type.substr(0, type.find(':'));
}

void add_text(SDOPackage::NVList& list, std::string_view name, std::string_view text) {
    const CORBA::ULong at = list.length();
    list.length(at + 1);
    list[at].name = corba_text(name);
    list[at].value <<= std::string(text).c_str();
}

void set_text(SDOPackage::NVList& list, std::string_view name, std::string_view text) {
    for (CORBA::ULong i = 0; i < list.length(); ++i) {
        if (name != list[i].name.in()) continue;
        list[i].value <<= std::string(text).c_str();
        return;
    }
    add_text(list, name, text);
}

}  // namespace nezumi::openrtm
