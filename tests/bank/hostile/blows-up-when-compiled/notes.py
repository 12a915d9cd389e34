"""Eighteen finally inside one another: the compiler writes out each of them twice."""

try:
 pass
finally:
 try:
  pass
 finally:
  try:
   pass
  finally:
   try:
    pass
   finally:
    try:
     pass
    finally:
     try:
      pass
     finally:
      try:
       pass
      finally:
       try:
        pass
       finally:
        try:
         pass
        finally:
         try:
          pass
         finally:
          try:
           pass
          finally:
           try:
            pass
           finally:
            try:
             pass
            finally:
             try:
              pass
             finally:
              try:
               pass
              finally:
               try:
                pass
               finally:
                try:
                 pass
                finally:
                 try:
                  pass
                 finally:
                  x = y = z = 0
                  x = y = z = 0
                  x = y = z = 0
                  x = y = z = 0
