def test_it_is_all_right():
    pass


def test_and_again_0():
    pass


def test_and_again_1():
    pass


def test_and_again_2():
    pass


def test_and_again_3():
    pass


def test_and_again_4():
    pass


def test_and_again_5():
    pass


def test_and_again_6():
    pass


def test_and_again_7():
    pass


def test_and_again_8():
    pass


def test_and_again_9():
    pass


def test_and_again_10():
    pass


def test_and_again_11():
    pass


def test_and_again_12():
    pass


def test_and_again_13():
    pass


def test_and_again_14():
    pass


def test_and_again_15():
    pass


def test_and_again_16():
    pass


def test_and_again_17():
    pass


def test_and_again_18():
    pass


def test_and_again_19():
    pass
