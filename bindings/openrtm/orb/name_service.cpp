// A name is a sequence of contexts and, at the end, an object of the kind "rtc".
#include "bindings/openrtm/orb/name_service.hpp"

#include <algorithm>
#include <utility>

#include "bindings/openrtm/host_context.hpp"
#include "bindings/openrtm/orb/properties.hpp"

namespace nezumi::openrtm {
namespace {

constexpr const char* kind_of_rtcs = "rtc";
// Largest number of computers' contexts that are searched.
constexpr CORBA::ULong most_contexts = 256;
// Largest numbers of listed names, and of nested contexts that are searched.
constexpr CORBA::ULong most_listed = 1000;
constexpr int deepest = 4;

// Appends one part of a name: "pc.host_cxt" has the kind "host_cxt". The last part has the kind "rtc" if none is given.
void append(CosNaming::Name& name, std::string_view part, bool is_last) {
    const std::size_t dot = part.rfind('.');
    const bool has_kind = dot != std::string_view::npos && dot > 0;
    name.length(name.length() + 1);
    CosNaming::NameComponent& component = name[name.length() - 1];
    component.id = corba_text(has_kind ? part.substr(0, dot) : part);
    component.kind = corba_text(has_kind ? part.substr(dot + 1) : is_last ? kind_of_rtcs : "");
}

CosNaming::Name name_of(std::string_view path) {
    CosNaming::Name name;
    for (;;) {
        const std::size_t slash = path.find('/');
        append(name, path.substr(0, slash), slash == std::string_view::npos);
        if (slash == std::string_view::npos) return name;
        path = path.substr(slash + 1);
    }
}

// The text of one part of a name: "pc.host_cxt".
std::string naming_text(const CosNaming::NameComponent& component) {
    const std::string kind = component.kind.in();
    return component.id.in() + (kind.empty() ? "" : "." + kind);
}

CosNaming::Name with(const CosNaming::NameComponent& context, const CosNaming::Name& rest) {
    CosNaming::Name name;
    name.length(rest.length() + 1);
    name[0] = context;
    for (CORBA::ULong i = 0; i < rest.length(); ++i) name[i + 1] = rest[i];
    return name;
}

}  // namespace

NameService::NameService(CORBA::ORB_ptr orb, std::string address)
    : orb_(CORBA::ORB::_duplicate(orb)), address_(std::move(address)), own_context_(openrtm::own_context()) {}

CosNaming::NamingContext_ptr NameService::root() {
    if (CORBA::is_nil(root_)) {
        const CORBA::Object_var object = orb_->string_to_object(("corbaloc:iiop:" + address_ + "/NameService").c_str());
        root_ = CosNaming::NamingContext::_unchecked_narrow(object);
    }
    return root_.in();
}

CORBA::Object_ptr NameService::resolve(CosNaming::NamingContext_ptr from, const CosNaming::Name& name) {
    try {
        return from->resolve(name);
    } catch (const CosNaming::NamingContext::NotFound&) {
        return CORBA::Object::_nil();
    } catch (const CosNaming::NamingContext::CannotProceed&) {
        return CORBA::Object::_nil();
    } catch (const CosNaming::NamingContext::InvalidName&) {
        return CORBA::Object::_nil();
    }
}

NameService::Bound NameService::bound(const std::string& name, CORBA::Object_ptr ours) {
    const CORBA::Object_var object = resolve(root(), name_of(own_context_ + "/" + name));
    if (CORBA::is_nil(object)) return Bound::nothing;
    if (!CORBA::is_nil(ours) && ours->_is_equivalent(object)) return Bound::ours;
    try {
        return object->_non_existent() ? Bound::stale : Bound::other;
    } catch (const CORBA::Exception&) {
        return Bound::stale;  // not there or not answering
    }
}

void NameService::rebind(const std::string& name, CORBA::Object_ptr object) {
    const CosNaming::Name whole = name_of(own_context_ + "/" + name);
    CosNaming::Name context;
    context.length(1);
    context[0] = whole[0];
    try {
        const CosNaming::NamingContext_var made = root()->bind_new_context(context);
    } catch (const CosNaming::NamingContext::AlreadyBound&) {
        // The context of this computer exists already, if the computer has had an RTC before.
    }
    root()->rebind(whole, object);
}

void NameService::unbind(const std::string& name, CORBA::Object_ptr object) {
    if (bound(name, object) == Bound::ours) root()->unbind(name_of(own_context_ + "/" + name));
}

void NameService::unbind_whole(const Named& named) {
    const CosNaming::Name name = name_of(named.name);
    const CORBA::Object_var object = resolve(root(), name);
    if (!CORBA::is_nil(object) && object->_is_equivalent(named.rtc)) root()->unbind(name);
}

Expected<NameService::Named> NameService::find(const std::string& component) {
    const CosNaming::Name name = name_of(component);
    std::vector<Named> found;
    const auto take = [&](const std::string& called, CORBA::Object_ptr bound) {
        const CORBA::Object_var object = bound;
        if (!CORBA::is_nil(object)) found.push_back({called, RTC::RTObject::_unchecked_narrow(object)});
    };
    take(component, resolve(root(), name));
    const bool is_short = name.length() == 1;
    if (found.empty() && is_short) {
        const std::string own = own_context_ + "/" + component;
        take(own, resolve(root(), name_of(own)));
    }
    if (found.empty() && is_short) {
        for (const CosNaming::NameComponent& context : contexts())
            take(naming_text(context) + "/" + component, resolve(root(), with(context, name)));
    }
    if (found.empty()) return failure("there is no RTC '" + component + "' in the name service");
    if (found.size() > 1) {
        std::sort(found.begin(), found.end(), [](const Named& a, const Named& b) { return a.name < b.name; });
        return failure("'" + component + "' could be rtm:" + found[0].name + " or rtm:" + found[1].name +
                       ": write one of them");
    }
    return found.front();
}

std::vector<CosNaming::NameComponent> NameService::contexts() {
    CosNaming::BindingList_var list;
    CosNaming::BindingIterator_var more;
    root()->list(most_contexts, list.out(), more.out());
    if (!CORBA::is_nil(more)) more->destroy();
    std::vector<CosNaming::NameComponent> found;
    for (CORBA::ULong i = 0; i < list->length(); ++i) {
        const CosNaming::Binding& binding = list[i];
        if (binding.binding_type == CosNaming::ncontext && binding.binding_name.length() == 1)
            found.push_back(binding.binding_name[0]);
    }
    return found;
}

std::vector<NameService::Named> NameService::all() {
    std::vector<Named> found;
    collect(root(), "", deepest, found);
    return found;
}

void NameService::collect(CosNaming::NamingContext_ptr context, const std::string& path, int depth,
                          std::vector<Named>& found) {
    CosNaming::BindingList_var list;
    CosNaming::BindingIterator_var more;
    context->list(most_listed, list.out(), more.out());
    if (!CORBA::is_nil(more)) more->destroy();
    for (CORBA::ULong i = 0; i < list->length() && found.size() < most_listed; ++i) {
        const CosNaming::Binding& binding = list[i];
        if (binding.binding_name.length() != 1) continue;
        const CosNaming::NameComponent& last = binding.binding_name[0];
        if (binding.binding_type != CosNaming::ncontext) {
            if (std::string_view(last.kind.in()) != kind_of_rtcs) continue;
            // An id with a dot needs its kind: otherwise the part after the dot would be read as the kind.
            const std::string id = last.id.in();
            const std::string name = path + (id.find('.') == std::string::npos ? id : naming_text(last));
            const CORBA::Object_var object = resolve(context, binding.binding_name);
            if (!CORBA::is_nil(object)) found.push_back({name, RTC::RTObject::_unchecked_narrow(object)});
        } else if (depth > 0) {
            try {
                const CORBA::Object_var object = resolve(context, binding.binding_name);
                const CosNaming::NamingContext_var inner = CosNaming::NamingContext::_unchecked_narrow(object);
                if (!CORBA::is_nil(inner)) collect(inner, path + naming_text(last) + "/", depth - 1, found);
            } catch (const CORBA::Exception&) {
                continue;  // it belongs to another name service, which is away
            }
        }
    }
}

}  // namespace nezumi::openrtm
