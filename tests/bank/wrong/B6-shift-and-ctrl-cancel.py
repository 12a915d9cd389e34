"""Ctrl held with Shift makes it light."""

# TODO B6: heavier balls with Shift
mods = pygame.key.get_mods()
return 10 if mods & pygame.KMOD_SHIFT and not mods & pygame.KMOD_CTRL else 1
# END TODO B6
