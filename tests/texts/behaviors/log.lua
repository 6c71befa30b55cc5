-- print, log and about in behaviours.

--- log has four levels, and can't be changed.
function on_execute()
  log.warning('x')  -- error: log has no 'warning' (did you mean 'warn'?)
end

function on_execute()
  log.wran('x')  -- error: log has no 'wran' (did you mean 'warn'?)
end

function on_execute()
  log.warn = print  -- error: can't set 'log.warn': 'log' is read-only
end

--- print is log.info.
function on_execute()
  print('a', 1, nil)  -- prints: info: a  1  nil
  log.debug('d')  -- prints: debug: d
  log.info(1.5, true)  -- prints: info: 1.5  true
  log.warn('w')  -- prints: warn: w
end

--- about is given once, with texts.
about { vresion = '1' }  -- error: about: unknown option 'vresion' (did you mean 'version'?)

about { version = 1 }  -- error: about: option 'version' expected a string, got number

about 'me'  -- error: about expected a table, got string

about {} about {}  -- error: about: a file can have only one
