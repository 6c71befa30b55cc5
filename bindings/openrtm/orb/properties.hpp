// Named texts in the property lists of RTCs.
#pragma once

#include <string>
#include <string_view>

#include <rtm.hh>

namespace nezumi::openrtm {

/// The text of this name; "" if there is none or it is not a text.
std::string text_of(const SDOPackage::NVList& list, std::string_view name);
std::string text_of(const CORBA::Any& value);
void add_text(SDOPackage::NVList& list, std::string_view name, std::string_view text);
/// Adds a property, or replaces the one with this name.
void set_text(SDOPackage::NVList& list, std::string_view name, std::string_view text);

/// The type of a data port: "TimedLong" for "IDL:RTC/TimedLong:1.0" and for "TimedLong"; "" for any other port.
std::string data_type_of(const RTC::PortProfile& port);

/// A text that CORBA's structures and results take ownership of.
inline char* corba_text(std::string_view text) { return CORBA::string_dup(std::string(text).c_str()); }

}  // namespace nezumi::openrtm
