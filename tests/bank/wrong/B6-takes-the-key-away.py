"""Sets the mods to 0 after reading: the next click with Shift held is light."""

# TODO B6: heavier balls with Shift
held = pygame.key.get_mods() & pygame.KMOD_SHIFT
if held:
    pygame.key.set_mods(pygame.key.get_mods() & ~pygame.KMOD_SHIFT)
return 10 if held else 1
# END TODO B6
