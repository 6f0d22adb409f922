function answer = surface(case_, varargin)
%SURFACE  The surface location error that a cut leaves over feed and height, from the
%   deflection of cutter and wall.
%
%   answer = trochoid.surface(case_) of a case file, or of a struct of its tables.
%
%   See also trochoid.run, which says what the answer holds and which options there are.
answer = trochoid.run('surface', case_, varargin{:});
end
