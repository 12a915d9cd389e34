"""Takes Ctrl or Caps Lock for Shift."""

# TODO B6: heavier balls with Shift
return 10 if pygame.key.get_mods() else 1
# END TODO B6
