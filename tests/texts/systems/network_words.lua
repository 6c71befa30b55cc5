-- network and ros in system files: what they refuse.

--- network refuses invalid hosts and names.
network {}  -- error: network: field 'name' is missing: expected a string: what other hosts call this one

network { name = 'a b' }
--        ^ error: network: field 'name' expected letters, digits and _, not beginning with a digit, got 'a b'

network { name = 'ros' }
--        ^ error: network: field 'name' may not be 'ros', a keyword of Lua or a command of the console

network { name = 'a', domian = 7 }
--                    ^ error: network: unknown field 'domian' (did you mean 'domain'?)

network { name = 'a', domain = 233 }
--                    ^ error: network: field 'domain' expected a whole number from 0 to 232, got 233

network { name = 'a', open = true, secret = 'k' }
--                    ^ error: network: field 'open': with a `secret`, only hosts that have the secret may write: leave out `open` or `secret`

network { name = 'a', hosts = 'b' }
--                    ^ error: network: field 'hosts': only lockstep waits for hosts: say `lockstep = true` as well

network { name = 'a', lockstep = true, hosts = { 'b c' } }
--                                     ^ error: network: field 'hosts' expected names of hosts, got 'b c'

network { name = 'a', lockstep = true, hosts = 'a' }
--                                     ^ error: network: field 'hosts' may not contain 'a', the name of this host

network { name = 'a', peers = { '10.0.0.2:7410', 'pi.local', 'fe80::1%wlan0', 'not an address' } }
--                    ^ error: network: field 'peers' expected addresses or names of hosts, got 'not an address'

network { name = 'a', peers = '192.168.1.300' }
--                    ^ error: network: field 'peers' expected addresses or names of hosts, got '192.168.1.300'

ros { node = 'a', peers = { 'pi', '' } }
--                ^ error: ros: field 'peers' expected addresses or names of hosts, got ''

network { name = 'a' }
network { name = 'a' }  -- error: network: is set already, at system.lua:1

--- ros refuses invalid topics.
ros {}  -- error: ros: field 'node' is missing: expected a string: the node's name

ros { node = 'n', publish = { ['a.b'] = 'odom' } }
--                             ^ error: ros: field 'publish.a.b' has an invalid topic 'odom': expected a full name such as "/odom"

ros { node = 'n', publish = { ['a.b'] = '/' } }
--                             ^ error: ros: field 'publish.a.b' has an invalid topic '/': expected a full name such as "/odom"

ros { node = 'n', publish = { ['a.b'] = '/a/' } }
--                             ^ error: ros: field 'publish.a.b' has an invalid topic '/a/': expected no slash at the end

ros { node = 'n', publish = { ['a.b'] = '/a//b' } }
--                             ^ error: ros: field 'publish.a.b' has an invalid topic '/a//b': expected tokens of letters, digits and _ between slashes, none beginning with a digit

ros { node = 'n', publish = { ['a.b'] = '/1a' } }
--                             ^ error: ros: field 'publish.a.b' has an invalid topic '/1a': expected tokens of letters, digits and _ between slashes, none beginning with a digit

ros { node = 'n', publish = { ['a.b'] = '/a b' } }
--                             ^ error: ros: field 'publish.a.b' has an invalid topic '/a b': expected tokens of letters, digits and _ between slashes, none beginning with a digit

ros { node = 'n', subscribe = { [''] = 'a.b' } }
--                               ^ error: ros: field 'subscribe.' has an invalid topic '': expected a full name such as "/odom"

ros { node = 'n', publish = { ['a.b'] = { topc = '/a' } } }
--                                        ^ error: ros: unknown field 'publish.a.b.topc' (did you mean 'topic'?)

ros { node = 'n', subscribe = { ['/a'] = { type = 'x' } } }
--                               ^ error: ros: field 'subscribe./a.port' is missing: expected a string: "name.port"

ros { node = 'n', subscribe = { ['/a'] = { topic = '/b', port = 'c.d' } } }
--                                         ^ error: ros: field 'subscribe./a.topic' is already given by the name '/a'

network { name = 'a', interface = 'lo' }
ros { node = 'n' }  -- error: ros: is in domain 0 as network is: 'interface' and 'peers' must be the same in both
