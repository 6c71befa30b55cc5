// Named texts in the lists that RTCs exchange.
#pragma once

#include <string>
#include <string_view>

#include <rtm.hh>

namespace nezumi::openrtm {

/// The text of this name; "" where there is none, or where it is no text.
std::string text_of(const SDOPackage::NVList& list, std::string_view name);
std::string text_of(const CORBA::Any& value);
void add_text(SDOPackage::NVList& list, std::string_view name, std::string_view text);
/// Adds it, or takes the place of the one of this name.
void set_text(SDOPackage::NVList& list, std::string_view name, std::string_view text);

/// The type of a data port, "TimedLong" of "IDL:RTC/TimedLong:1.0" and of "TimedLong"; "" of any other port.
std::string data_type_of(const RTC::PortProfile& port);

/// A text as CORBA's structures and results take it over.
inline char* corba_text(std::string_view text) { return CORBA::string_dup(std::string(text).c_str()); }

}  // namespace nezumi::openrtm
