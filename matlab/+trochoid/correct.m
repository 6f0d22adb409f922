function answer = correct(case_, varargin)
%CORRECT  The motion of the table that makes the flutes cut alike, and the feedforward command
%   for it.
%
%   answer = trochoid.correct(case_) of a case file, or of a struct of its tables.
%
%   See also trochoid.run, which says what the answer holds and which options there are.
answer = trochoid.run('correct', case_, varargin{:});
end
